"""Options that several verbs share, and opening a backend."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import RunError
from mc_nested.live.action_log import FailureBudget
from mc_nested.live.devices import Display
from mc_nested.live.journal import Journal
from mc_nested.live.recording.run_recorder import OpenRecorder, no_recorder
from mc_nested.live.session import open_live_game
from sim.grid import GridGame, GridVectorEnv


class Backend(str, Enum):
    """The backend: the headless simulator, the virtual client on its own clock, or a running game's window."""

    SIM = "sim"
    VIRTUAL = "virtual"
    LIVE = "live"


def where_words(backend: Backend) -> str:
    """Where it is played, in words."""
    words = {Backend.SIM: "in the simulator", Backend.VIRTUAL: "on the virtual client"}
    return words.get(backend, "in the running game")


RunArgument = Annotated[Path, typer.Argument(metavar="RUN", help="the folder of a training (its --out)")]
BackendOption = Annotated[
    Backend, typer.Option(help="the headless simulator, the virtual client, or a running game's window")
]
ProfileOption = Annotated[
    str | None, typer.Option(metavar="NAME|FILE", help="the profile of your game and screen (default: 'default')")
]

EngineOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="what computes: compiled, or torch [the preset's]")
]
DeviceOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="where torch computes: cpu, cuda or mps [the preset's]")
]
StatesOption = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="what the agent sees: numbers, an image, or the screen [the preset's]"),
]

ServerOption = Annotated[
    bool, typer.Option("--server-allowed", help="play even where the window's title says Multiplayer")
]
ProfileToWrite = Annotated[str, typer.Option(metavar="NAME|FILE", help="the profile to write; new if there is none")]

DEFAULT_PROFILE = "default"


@contextmanager
def open_game(
    backend: Backend,
    profile: str | None,
    scenario: Scenario,
    *,
    server_allowed: bool = False,
    evidence: Path | None = None,
    open_recorder: OpenRecorder = no_recorder,
    journal: Journal | None = None,
) -> Iterator[tuple[Game, Display | None]]:
    """The backend's game, and its window, if it has one; both are closed after the block.

    ``evidence`` is the folder for the last frames of a live game that was given up; ``open_recorder`` opens what
    records it; ``journal`` is told what it does.

    DesktopError or ProfileError, one line each if a live game can't be played.
    """
    if backend is Backend.SIM:
        yield GridGame(scenario), None
        return
    if backend is Backend.VIRTUAL:
        # Imported here: no other backend needs it, and every verb would wait for it.
        from mc_nested.cli.virtual_games import open_virtual_games

        with open_virtual_games([scenario], journal=journal) as (game,):
            yield game, game.connection.devices.display
        return
    say = partial(typer.echo, err=True)
    with open_live_game(
        scenario,
        DEFAULT_PROFILE if profile is None else profile,
        say,
        evidence=evidence,
        is_server_allowed=server_allowed,
        open_recorder=open_recorder,
        journal=journal,
    ) as live:
        yield live


@contextmanager
def open_arenas(
    backend: Backend,
    profile: str | None,
    scenarios: Sequence[Scenario],
    *,
    server_allowed: bool = False,
    evidence: Path | None = None,
    open_recorder: OpenRecorder = no_recorder,
    journal: Journal | None = None,
    seed: int = 0,
) -> Iterator[tuple[GridVectorEnv | ArenaVectorEnv, PlayLog | None]]:
    """The backend's arenas, one per scenario, and the log of playing them, if any; closed after the block.

    ``seed`` is of the virtual clients' random numbers. RunError if a live game should be several arenas; otherwise as
    ``open_game``.
    """
    if backend is Backend.SIM:
        yield GridVectorEnv(scenarios), None
        return
    if backend is Backend.VIRTUAL:
        from mc_nested.cli.virtual_games import VirtualPlay, open_virtual_games

        with open_virtual_games(scenarios, seed, journal) as games:
            envs = [ArenaEnv(game, scenario) for game, scenario in zip(games, scenarios, strict=True)]
            yield ArenaVectorEnv(envs), VirtualPlay(games)
        return
    if len(scenarios) != 1:
        raise RunError(f"a live game is one arena, not {len(scenarios)}: train one trial at a time, --trials 1")
    opened = open_game(
        backend,
        profile,
        scenarios[0],
        server_allowed=server_allowed,
        evidence=evidence,
        open_recorder=open_recorder,
        journal=journal,
    )
    with opened as (game, _):
        yield ArenaVectorEnv([ArenaEnv(game, scenarios[0])]), game.log


def played_live(log: PlayLog | None, failure_budget: FailureBudget) -> dict[str, Any]:
    """What playing in a running game, or on the virtual client, took, for a summary; nothing for the simulator."""
    return {"live": {**log.summary(), **failure_budget.summary()}} if log else {}
