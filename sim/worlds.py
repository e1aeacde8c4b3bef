"""The worlds that an agent plays in: the headless simulator, the virtual client on its own clock, a running game."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from enum import Enum

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import RunError, UserError
from mc_nested.learn.dqn.engines import SCREEN
from mc_nested.live.devices import Display
from mc_nested.live.screen_arenas import NEEDS_A_WINDOW, ScreenArenas
from mc_nested.live.session import Opening, open_live_game
from sim.grid import GridGame, GridVectorEnv


class Backend(str, Enum):
    """A backend is the headless simulator, the virtual client on its own clock, or a running game's window."""

    SIM = "sim"
    VIRTUAL = "virtual"
    LIVE = "live"


def where_words(backend: Backend) -> str:
    """Say where it is played."""
    words = {Backend.SIM: "in the simulator", Backend.VIRTUAL: "on the virtual client"}
    return words.get(backend, "in the running game")


@contextmanager
def open_game(backend: Backend, scenario: Scenario, opening: Opening) -> Iterator[tuple[Game, Display | None]]:
    """Open the backend's game, and its window, if it has one; both are closed after the block.

    ``opening`` says how a live game is opened; a game on the virtual client takes only its journal.

    DesktopError or ProfileError, one line each if a live game can't be played.
    """
    if backend is Backend.SIM:
        yield GridGame(scenario), None
    elif backend is Backend.VIRTUAL:
        # Imported here: no other backend needs it, and every verb would wait for it.
        from sim.virtual_games import open_virtual_games

        with open_virtual_games([scenario], journal=opening.journal) as (game,):
            yield game, game.connection.devices.display
    else:
        with open_live_game(scenario, opening) as live:
            yield live


@contextmanager
def open_arenas(
    backend: Backend, scenarios: Sequence[Scenario], opening: Opening, seed: int = 0
) -> Iterator[tuple[GridVectorEnv | ArenaVectorEnv, PlayLog | None]]:
    """Open the backend's arenas, one per scenario, and the log of playing them, if any; closed after the block.

    ``seed`` is of the virtual clients' random numbers. RunError if a live game should be several arenas; otherwise as
    ``open_game``.
    """
    if backend is Backend.SIM:
        yield GridVectorEnv(scenarios), None
    elif backend is Backend.VIRTUAL:
        from sim.virtual_games import VirtualPlay, open_virtual_games

        with open_virtual_games(scenarios, seed, opening.journal) as games:
            envs = [ArenaEnv(game, scenario) for game, scenario in zip(games, scenarios, strict=True)]
            yield ArenaVectorEnv(envs), VirtualPlay(games)
    elif len(scenarios) != 1:
        raise RunError(f"a live game is one arena, not {len(scenarios)}: train one trial at a time, --trials 1")
    else:
        with open_live_game(scenarios[0], opening) as (game, _):
            yield ArenaVectorEnv([ArenaEnv(game, scenarios[0])]), game.log


def check_window(states: str, has_window: bool) -> None:
    """Raise UserError if such states need a window, and there is none."""
    if states == SCREEN and not has_window:
        raise UserError(NEEDS_A_WINDOW)


def as_shown(arenas: GridVectorEnv | ArenaVectorEnv, states: str) -> GridVectorEnv | ArenaVectorEnv | ScreenArenas:
    """Return the arenas, or what their windows show of them, as an agent of such states sees them.

    UserError if the states need a window, and there is none.
    """
    if states != SCREEN:
        return arenas
    if isinstance(arenas, GridVectorEnv):
        raise UserError(NEEDS_A_WINDOW)
    return ScreenArenas(arenas)
