"""``mc-nested play``: watch a trained agent build, in the simulator or in a running game."""

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.atomic_file import atomic_write
from mc_nested.cli.options import (
    DEFAULT_PROFILE,
    BackendOption,
    ProfileOption,
    RecordOption,
    RunArgument,
    ServerOption,
    opening_of,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints, say_aside
from mc_nested.cli.runs import greedy_episodes
from mc_nested.cli.view import Viewed, ViewOption, viewed
from mc_nested.cli.watching import VideoOption, filmed, times_of, watched
from mc_nested.errors import RunError, UserError
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.engines import SCREEN
from mc_nested.learn.evaluation import GreedyEpisode, build_greedily, play_greedily
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.live.devices import Display
from mc_nested.live.input.stops import Takeover
from mc_nested.live.live_game import started_over
from mc_nested.live.menus.click_points import picture_bytes
from mc_nested.report.film import EpisodeFilm, check_film
from sim.worlds import Backend, as_shown, check_window, open_game, where_words


@dataclass(frozen=True)
class PlayResult:
    """What ``play`` prints."""

    folder: Annotated[Path, "the run's folder"]
    trial: Annotated[int, "which one played"]
    scenario: Annotated[str, "the design's name"]
    score: Annotated[float, "of the episode"]
    optimum: Annotated[float, "the highest score possible"]
    material: Annotated[str, "that was chosen"]
    steps: Annotated[int, "of the episode"]
    screenshots: Annotated[Path | None, "their folder"]
    film: Annotated[Path | None, "its file"]


@prints(PlayResult)
def play(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    run: RunArgument,
    backend: BackendOption = Backend.SIM,
    profile: ProfileOption = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    trial: Annotated[int | None, typer.Option(min=0, help="which trial plays", show_default="the best one")] = None,
    screenshots: Annotated[
        bool, typer.Option("--screenshots", help="keep a picture of the window after each step, under RUN/screenshots")
    ] = False,
    video: VideoOption = None,
    view: ViewOption = False,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Play one greedy episode and show the arena as it is built; after a mishap the episode starts over."""
    output = Output(quiet, as_json)
    if video:
        check_film(video)
    folder = RunFolder.open(run)
    scenario = folder.scenario
    if folder.team:
        raise UserError(f"several builders play in the simulator alone: mc-nested runs evaluate {run} has them build")
    if screenshots and backend is Backend.SIM:
        raise UserError("the simulator has no window to picture: leave out --screenshots, or play --backend live")
    states = folder.config.preset.states
    check_window(states, backend is not Backend.SIM)
    agent, which = _choose(folder, trial)
    opening = opening_of(profile, f"play-{scenario.name}", record, server_allowed=server_allowed, backend=backend)
    with viewed(view, "play", f"{scenario.name}, trial {which}, {where_words(backend)}") as viewing:
        publisher = viewing.publisher
        takeover = Takeover(publisher.offer_takeover)
        opening = replace(opening, evidence=folder.path / "evidence", journal=publisher.board, takeover=takeover)
        window = open_game(backend, scenario, opening)
        with window as (game, display), filmed(game, display, video) as film:
            pictures = _Screenshots(folder.path / "screenshots", display) if screenshots and display else None
            is_quiet = output.quiet or output.as_json
            watch = partial(_watch, game, folder, agent, which, pictures, viewing, film, is_quiet=is_quiet)
            episode = started_over(watch, say_aside)
            times = times_of(game)
    material = episode.material_name(scenario)
    found = PlayResult(
        folder=folder.path,
        trial=which,
        scenario=scenario.name,
        score=episode.score,
        optimum=scenario.optimum,
        material=material,
        steps=len(episode.actions),
        screenshots=pictures.folder if pictures else None,
        film=video,
    )
    lines = [f"  score {episode.score:g} of {scenario.optimum:g}, in {material}, {len(episode.actions)} steps", *times]
    if pictures:
        lines.append(f"  screenshots: {pictures.folder}")
    if video:
        lines.append(f"  film: {video}")
    output.result(found, *lines)


def _watch(
    game: Game,
    folder: RunFolder,
    agent: Agent,
    which: int,
    pictures: "_Screenshots | None",
    viewing: Viewed,
    film: EpisodeFilm | None,
    *,
    is_quiet: bool,
) -> GreedyEpisode:
    """Play one greedy episode, shown as it is built."""
    scenario = folder.scenario
    env = ArenaEnv(game, scenario)
    if pictures:
        pictures.begin()
    take_picture = pictures.take if pictures else lambda: None
    with watched(env, f"{scenario.name}, trial {which}", viewing, film, quiet=is_quiet) as show:
        if folder.config.trains_objectives:
            return build_greedily(env, agent, show, take_picture)
        arenas = agent.view_of(as_shown(ArenaVectorEnv([env]), folder.config.preset.states), [scenario])
        return play_greedily(arenas, [scenario], agent, show, take_picture)[0]


def _choose(folder: RunFolder, trial: int | None) -> tuple[Agent, int]:
    """Return the agent of one trial, and which trial: the one asked for, or the best in the simulator.

    One that sees a window is the best by the scores that it was kept for: the simulator has no window.
    """
    agent = folder.trained_agent()
    if trial is None:
        if folder.config.preset.states == SCREEN:
            scores = folder.policies()["scores"].tolist()
        else:
            scores = [episode.score for episode in greedy_episodes(folder, agent)]
        trial = scores.index(max(scores))
    if trial >= folder.config.trials:
        raise RunError(f"{folder.path}: has no trial {trial}: choose 0 to {folder.config.trials - 1}")
    alone = folder.new_agent(1)
    alone.load_online(folder.policy_of(trial))
    return alone, trial


class _Screenshots:
    """Pictures of the game's window alone, numbered in the order they are taken.

    Those of an earlier episode are removed. Raises RunError if one can't be written.
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
        with atomic_write(path) as unfinished:
            unfinished.write_bytes(picture_bytes(self._display.grab()))
