"""How exact and how fast the live path plays in a real window, the stand-in's, by its server's own account.

    python scripts/bench_standin.py [--actions 200] [--seed 0] [--json]

Takes actions drawn evenly from those of the eight that the rules don't void, and asks the server after each where the
player is and what stands in the arena. The stand-in (scripts/standin.py, Linux) is started where it isn't up, and stays
up if it was. Times are a wall clock's, from act() called to returned, confirmed on the screen; the machine draws the
game without a graphics card at the same time, so they say as much about it. Exit code 1 where anything was wrong.
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
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.coordinates import cell_at
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import load_profile
from mc_nested.live.profile_tables import Arena
from mc_nested.live.session import open_live_game
from scripts import standin_oracle
from scripts.bench_live import Play, drawn_action, figures

AT_REST_S = 0.3
"""Seconds of the same place, by the server's account, that are standing: coasting is over within them."""


@contextmanager
def standin_up() -> Iterator[dict[str, Any]]:
    """The stand-in's state while it is up, taken down again if it wasn't up before."""
    script = [sys.executable, str(Path(__file__).with_name("standin.py"))]
    was_up = subprocess.run([*script, "status"], capture_output=True, check=False).returncode == 0  # noqa: S603 - fixed
    done = subprocess.run([*script, "up"], stdout=subprocess.PIPE, text=True, check=False)  # noqa: S603 - fixed
    if done.returncode:
        raise SystemExit(done.returncode)
    try:
        yield json.loads(done.stdout)
    finally:
        if not was_up:
            subprocess.run([*script, "down"], check=True)  # noqa: S603 - fixed


def in_its_window(state: dict[str, Any], scenario: Scenario, count: int, seed: int) -> Play:
    """Play in the stand-in's window; what held on to its display has let go when this returns."""
    os.environ["DISPLAY"] = state["display"]
    arena = load_profile(state["profile"]).marked_arena()
    with open_live_game(scenario, state["profile"], lambda line: print(line, file=sys.stderr)) as (game, _):
        return play(game, scenario, arena, state["oracle"], count, seed)


def play(game: LiveGame, scenario: Scenario, arena: Arena, oracle: str, count: int, seed: int) -> Play:
    """Take ``count`` actions, and ask the server after each."""
    done = Play()
    rng = np.random.default_rng(seed)
    placed: set[rules.Cell] | None = None
    cell, steps = scenario.start, 0
    for _ in track(range(count), "actions", console=Console(stderr=True)):
        if placed is None:
            cell, placed, steps = game.reset(int(rng.integers(len(scenario.materials)))), set(), 0
        action = drawn_action(rng, cell, placed)
        done.actions += 1
        began = time.perf_counter()
        try:
            outcome = game.act(action)
        except LiveError:
            done.failed_actions += 1
            placed = None
            continue
        (done.placings_s if action in rules.PLACES else done.moves_s).append(time.perf_counter() - began)
        cell, steps = outcome.cell, steps + 1
        placed |= {outcome.placed} if outcome.placed else set()
        done.wrong_cells += cell_at(arena.place_of(_at_rest(oracle))) != cell
        done.wrong_blocks += set(standin_oracle.blocks(oracle, *arena.region)) != {arena.block_of(at) for at in placed}
        if len(placed) == scenario.blocks or steps == scenario.step_limit:
            placed = None
    done.corrections, done.second_clicks = game.log.effort.corrections, game.log.effort.second_clicks
    return done


def _at_rest(oracle: str) -> tuple[float, float, float]:
    """Where the server has the player, once that is the same twice."""
    before = None
    while before != (place := standin_oracle.ask(oracle, "/player")["position"]):
        before = place
        time.sleep(AT_REST_S)
    x, y, z = place
    return x, y, z


def main() -> int:
    """Play, and print what came of it; 1 where anything was wrong."""
    parser = argparse.ArgumentParser(description="How exact and how fast the live path plays in the stand-in's window.")
    parser.add_argument("--actions", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    scenario = load_scenario("diamond")
    with standin_up() as state:
        played = in_its_window(state, scenario, options.actions, options.seed)
    summary = figures(played)
    if options.json:
        print(json.dumps(summary))
    else:
        Console().print_json(data=summary)
    return 1 if played.wrong_cells or played.wrong_blocks else 0


if __name__ == "__main__":
    sys.exit(main())
