"""The contract of every Game, kept in a real window: the stand-in's (scripts/standin.py).

Run as a module it plays in the window of DISPLAY: a process of its own, since pyautogui keeps its first display.
"""

import subprocess
import sys
from collections.abc import Callable

import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import NotConfirmedError, WrongScreenError
from mc_nested.live.profile.store import load_profile
from mc_nested.live.session import Opening, open_live_game
from scripts import standin_game
from scripts.programs import ROOT
from tests.arena.game_contract import BUMPS, check_game, check_materials
from tests.standin_fixture import Standin

STALLS = ("carried on while it clicked", "was not just seen on the screen")
"""What an error says that a stall of the stand-in's frames brings about."""

TRIES = 3
"""Times that a check is begun."""


@pytest.mark.standin
def test_a_live_game_in_the_stand_ins_window_keeps_the_game_contract(standin: Standin) -> None:
    command = [sys.executable, "-m", "tests.live.test_standin_contract", str(standin.profile), standin.oracle]
    done = subprocess.run(command, cwd=ROOT, env=standin.env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert standin.errors() == []


def play_in_the_window(profile: str, oracle: str) -> None:
    """Raise AssertionError or LiveError where the game in the profile's window doesn't keep the contract."""
    line, flag = load_scenario("line"), load_scenario("flag")
    with open_live_game(line, Opening(profile, print)) as (game, _):
        start_over_after_a_stall(lambda: check_game(game, line, BUMPS))
    arena = load_profile(profile).marked_arena()

    def kinds() -> dict[Cell, str]:
        """Return the blocks that the server has in the arena."""
        cells = {arena.block_of((x, y)): (x, y) for x in range(flag.size) for y in range(flag.size)}
        return {cells[block]: name for block, name in standin_game.blocks(oracle, *arena.region).items()}

    with open_live_game(flag, Opening(profile, print)) as (game, _):
        start_over_after_a_stall(lambda: check_materials(game, flag, build_with_materials(flag), kinds))


def start_over_after_a_stall(check: Callable[[], None], tries: int = TRIES) -> None:
    """Begin the check again where a stall of the stand-in's frames carried the agent on, as a trainer does (FACTS).

    So too where each look before a press took so long that none was fresh, and nothing was pressed.
    """
    try:
        check()
    except (NotConfirmedError, WrongScreenError) as error:
        if tries == 1 or not any(stall in str(error) for stall in STALLS):
            raise
        print(f"starts over: {error}")
        start_over_after_a_stall(check, tries - 1)


if __name__ == "__main__":
    play_in_the_window(*sys.argv[1:])
