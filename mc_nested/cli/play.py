"""``mc-nested play``: watch a trained agent build, in the simulator or in a running game."""

from pathlib import Path
from typing import Annotated

import cv2
import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.evaluate import greedy_episodes, load_agent
from mc_nested.cli.options import Backend, BackendOption, ProfileOption, RunArgument, ServerOption, open_game
from mc_nested.errors import LiveError, NotInFrontError, RunError, StoppedError, UserError
from mc_nested.learn.agents import Agent, view_of
from mc_nested.learn.evaluation import GreedyEpisode, play_greedily
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.live.devices import Display
from mc_nested.report.terminal import arena_view

TRIES = 3
"""Attempts at an episode: a mishap in the running game may end all but the last."""


def play(
    run: RunArgument,
    backend: BackendOption = Backend.SIM,
    profile: ProfileOption = None,
    server_allowed: ServerOption = False,
    trial: Annotated[int | None, typer.Option(min=0, help="which trial plays (default: the best one)")] = None,
    screenshots: Annotated[
        bool, typer.Option("--screenshots", help="keep a picture of the window after each step, under RUN/screenshots")
    ] = False,
) -> None:
    """Play one greedy episode and show the arena as it is built; after a mishap the episode starts over."""
    folder = RunFolder.open(run)
    scenario = folder.scenario
    if screenshots and backend is Backend.SIM:
        raise UserError("the simulator has no window to picture: leave out --screenshots, or play --backend live")
    agent, which = _choose(folder, trial)
    evidence = folder.path / "evidence"
    with open_game(backend, profile, scenario, server_allowed=server_allowed, evidence=evidence) as (game, display):
        pictures = _Screenshots(folder.path / "screenshots", display) if screenshots and display else None
        for tries_left in reversed(range(TRIES)):
            try:
                episode = _watch(game, scenario, agent, which, pictures)
                break
            except (StoppedError, NotInFrontError):
                raise
            except LiveError as error:
                if not tries_left:
                    raise
                typer.echo(f"  {error}; the episode starts over", err=True)
    material = episode.material_name(scenario)
    typer.echo(f"  score {episode.score:g} of {scenario.optimum:g}, in {material}, {len(episode.actions)} steps")
    if pictures:
        typer.echo(f"  screenshots: {pictures.folder}")


def _watch(game: Game, scenario: Scenario, agent: Agent, which: int, pictures: "_Screenshots | None") -> GreedyEpisode:
    """One greedy episode, shown as it is built."""
    env = ArenaEnv(game, scenario)
    console = Console()
    if pictures:
        pictures.begin()
    with Live(console=console, auto_refresh=False) as live:

        def show() -> None:
            built = len(env.placed & scenario.design)
            line = Text(f"  {scenario.name}, trial {which}: {built} of {scenario.blocks} blocks on the design")
            live.update(Group(arena_view(scenario, env.cell, env.placed), line), refresh=True)
            if pictures:
                pictures.take()

        arenas = view_of(agent.spec, ArenaVectorEnv([env]), [scenario])
        episode = play_greedily(arenas, [scenario], agent, show)[0]
    if not console.is_terminal:
        console.print()  # rich leaves the last line unfinished then
    return episode


def _choose(folder: RunFolder, trial: int | None) -> tuple[Agent, int]:
    """The agent of one trial, and which trial: the one asked for, or the best in the simulator."""
    agent = load_agent(folder)
    if trial is None:
        scores = [episode.score for episode in greedy_episodes(folder, agent)]
        trial = scores.index(max(scores))
    if trial >= folder.config.trials:
        raise RunError(f"{folder.path}: has no trial {trial}: choose 0 to {folder.config.trials - 1}")
    alone = folder.new_agent(1)
    alone.load_networks(agent.networks_of(trial))
    return alone, trial


class _Screenshots:
    """Pictures of the game's window alone, numbered in the order they are taken.

    Those of an earlier episode are removed. RunError if one can't be written.
    """

    def __init__(self, folder: Path, display: Display) -> None:
        self.folder = folder
        self._display = display
        self._taken = 0

    def begin(self) -> None:
        self._taken = 0
        self.folder.mkdir(exist_ok=True)
        for old in self.folder.glob("[0-9][0-9][0-9].png"):
            old.unlink()

    def take(self) -> None:
        self._taken += 1
        path = self.folder / f"{self._taken:03d}.png"
        if not cv2.imwrite(str(path), self._display.grab()):
            raise RunError(f"{path}: can't be written: make room, or leave out --screenshots")
