"""States that are the game's window itself: where they can be seen, and the arenas as they show them."""

from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import UserError
from mc_nested.learn.dqn.engines import SCREEN
from mc_nested.live.screen_arenas import NEEDS_A_WINDOW, ScreenArenas
from sim.grid import GridVectorEnv


def check_window(states: str, has_window: bool) -> None:
    """UserError if such states need a window, and there is none."""
    if states == SCREEN and not has_window:
        raise UserError(NEEDS_A_WINDOW)


def as_shown(arenas: GridVectorEnv | ArenaVectorEnv, states: str) -> GridVectorEnv | ArenaVectorEnv | ScreenArenas:
    """The arenas, or what their windows show of them, as an agent of such states sees them; UserError without one."""
    if states != SCREEN:
        return arenas
    if isinstance(arenas, GridVectorEnv):
        raise UserError(NEEDS_A_WINDOW)
    return ScreenArenas(arenas)
