"""Measures how exactly and how fast the live path plays in a real window, the stand-in's; its server checks it.

    python scripts/bench_standin.py [--actions 200] [--seed 0] [--json]

Draws actions uniformly from those that the rules don't void. After each, asks the server where the player is and what
stands in the arena. The stand-in (scripts/standin.py, Linux) is started if it isn't up, and stays up if it was. Times
are wall-clock times of one call of act(), which confirms the action on the screen. The same computer draws the game
without a graphics card, so they say as much about the computer. Exit code 1 if anything was wrong.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena import rules
from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile
from mc_nested.live.session import open_live_game
from scripts import standin_oracle
from scripts.bench_live import PlayCounts, WorldTruth, drawn_action, figures

STANDSTILL_S = 0.3
"""A player whose position on the server stays the same for so long stands still: coasting is over by then."""


@contextmanager
def standin_up() -> Iterator[dict[str, Any]]:
    """The stand-in's state while it is up; it is taken down at the end unless it was up before."""
    script = [sys.executable, str(Path(__file__).with_name("standin.py"))]
    was_up = subprocess.run([*script, "status"], capture_output=True, check=False).returncode == 0  # noqa: S603 - fixed
    started = subprocess.run([*script, "up"], stdout=subprocess.PIPE, text=True, check=False)  # noqa: S603 - fixed
    if started.returncode:
        raise SystemExit(started.returncode)
    try:
        yield json.loads(started.stdout)
    finally:
        if not was_up:
            subprocess.run([*script, "down"], check=True)  # noqa: S603 - fixed


class ServerTruth:
    """What the stand-in's server says: the player's cell, and the blocks in the arena."""

    def __init__(self, arena: Arena, oracle: str) -> None:
        self._arena, self._oracle = arena, oracle

    def cell(self) -> Cell:
        """The cell that the player stands on, once they stand still."""
        return cell_at(self._arena.position_of(self._position_at_rest()))

    def is_built(self, placed: set[Cell]) -> bool:
        """Whether exactly these cells of the arena hold a block."""
        blocks = standin_oracle.blocks(self._oracle, *self._arena.region)
        return set(blocks) == {self._arena.block_of(cell) for cell in placed}

    def _position_at_rest(self) -> tuple[float, float, float]:
        before = None
        while before != (position := standin_oracle.ask(self._oracle, "/player")["position"]):
            before = position
            time.sleep(STANDSTILL_S)
        x, y, z = position
        return x, y, z


def play_in_window(state: dict[str, Any], scenario: Scenario, count: int, seed: int) -> PlayCounts:
    """Play in the stand-in's window; every connection to its display is closed afterwards."""
    os.environ["DISPLAY"] = state["display"]
    truth = ServerTruth(load_profile(state["profile"]).marked_arena(), state["oracle"])
    with open_live_game(scenario, state["profile"], lambda line: print(line, file=sys.stderr)) as (game, _):
        return play(game, scenario, truth, count, seed)


def play(game: LiveGame, scenario: Scenario, truth: WorldTruth, count: int, seed: int) -> PlayCounts:
    """Play ``count`` actions, each checked against the world."""
    counts = PlayCounts()
    rng = np.random.default_rng(seed)
    placed: set[Cell] | None = None
    cell, steps = scenario.start, 0
    for _ in track(range(count), "actions", console=Console(stderr=True)):
        if placed is None:
            cell, placed, steps = game.reset(int(rng.integers(len(scenario.materials)))), set(), 0
        action = drawn_action(rng, cell, placed, scenario.size)
        counts.actions += 1
        began = time.perf_counter()
        try:
            outcome = game.act(action)
        except LiveError:
            counts.failed_actions += 1
            placed = None
            continue
        (counts.placings_s if action in rules.PLACES else counts.moves_s).append(time.perf_counter() - began)
        cell, steps = outcome.cell, steps + 1
        placed |= {outcome.placed} if outcome.placed else set()
        counts.wrong_cells += truth.cell() != cell
        counts.wrong_blocks += not truth.is_built(placed)
        if len(placed) == scenario.blocks or steps == scenario.step_limit:
            placed = None
    counts.corrections, counts.second_clicks = game.log.effort.corrections, game.log.effort.second_clicks
    return counts


def main() -> int:
    """Play and print the figures; 1 if anything was wrong."""
    parser = argparse.ArgumentParser(
        description="How exactly and how fast the live path plays in the stand-in's window."
    )
    parser.add_argument("--actions", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    scenario = load_scenario("diamond")
    with standin_up() as state:
        played = play_in_window(state, scenario, options.actions, options.seed)
    summary = figures(played)
    if options.json:
        print(json.dumps(summary))
    else:
        Console().print_json(data=summary)
    return 1 if played.wrong_cells or played.wrong_blocks else 0


if __name__ == "__main__":
    sys.exit(main())
