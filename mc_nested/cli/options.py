"""Options that several verbs share, and opening a backend."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from gymnasium.vector import VectorEnv

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Int64s
from mc_nested.errors import RunError
from mc_nested.live.devices import Display
from mc_nested.live.failure_budget import FailureBudget
from mc_nested.live.session import open_live_game
from sim.grid import GridGame, GridVectorEnv


class Backend(str, Enum):
    """The backend: the headless simulator, or a running game's window."""

    SIM = "sim"
    LIVE = "live"


RunArgument = Annotated[Path, typer.Argument(metavar="RUN", help="the folder of a training (its --out)")]
BackendOption = Annotated[Backend, typer.Option(help="the headless simulator, or a running game's window")]
ProfileOption = Annotated[
    str | None, typer.Option(metavar="NAME|FILE", help="the profile of your game and screen (default: 'default')")
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
) -> Iterator[tuple[Game, Display | None]]:
    """The backend's game, and its window, if it has one; both are closed after the block.

    ``evidence`` is the folder for the last frames of a live game that was given up.

    DesktopError or ProfileError, one line each if a live game can't be played.
    """
    if backend is Backend.SIM:
        yield GridGame(scenario), None
        return
    say = partial(typer.echo, err=True)
    with open_live_game(
        scenario,
        DEFAULT_PROFILE if profile is None else profile,
        say,
        evidence=evidence,
        is_server_allowed=server_allowed,
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
) -> Iterator[tuple[VectorEnv[Int64s, Int64s, Any], PlayLog | None]]:
    """The backend's arenas, one per scenario, and the log of playing them, if any; closed after the block.

    RunError if a live game should be several arenas; otherwise as ``open_game``.
    """
    if backend is Backend.SIM:
        yield GridVectorEnv(scenarios), None
        return
    if len(scenarios) != 1:
        raise RunError(f"a live game is one arena, not {len(scenarios)}: train one trial at a time, --trials 1")
    with open_game(backend, profile, scenarios[0], server_allowed=server_allowed, evidence=evidence) as (game, _):
        yield ArenaVectorEnv([ArenaEnv(game, scenarios[0])]), game.log


def played_live(log: PlayLog | None, failure_budget: FailureBudget) -> dict[str, Any]:
    """What playing in a running game took, for a training's summary; nothing for the simulator."""
    return {"live": {**log.summary(), **failure_budget.summary()}} if log else {}
