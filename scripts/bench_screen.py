"""How much of where an agent stands its window shows: random walks, and how many of their states look alike.

    python scripts/bench_screen.py [--steps 2000] [--seed 0] [--pitch 53] [--json]

For an arena of 5 and one of 15 cells a side, as the virtual backend builds it, an agent plays random actions of those
that the rules don't void, with the step limit and blocks of a design of that size. Each step is drawn on the virtual
client, the agent exactly in its cell's middle, the debug screen off, and made small as the states "screen" are. So what
looks alike here looks alike in a game; what differs a little here may be lost there in where the agent came to stand.

``cells`` are the empty arena's cells, ``cells_seen`` how many pictures they have. ``states`` are the states (x, y, b)
of the walk. ``alike_1`` and ``alike_4`` are the shares of its steps whose picture, or four last pictures, also occur in
another of these states. ``in_view`` is the mean share of the arena's cells whose floor is in the picture, by the row
that the agent stands in.
"""

import argparse
import json
import math
import sys
from collections import defaultdict, deque
from collections.abc import Hashable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.cli.virtual_games import GUI_SCALE, PITCH, built_arena
from mc_nested.live.model.scales import Scales
from mc_nested.live.screen_arenas import FRAMES
from mc_nested.live.vision.world_greys import world_greys
from sim.client.client import VirtualClient
from sim.client.drawing.camera import projection, view
from sim.client.drawing.scenery import SEEN

SIZES = (5, 15)
EYE = 1.62
MATERIAL = "stone"

State = tuple[int, int, int]


class Pictured:
    """An arena whose states can be pictured."""

    def __init__(self, scenario: Scenario, pitch: float) -> None:
        self.scenario, self._pitch = scenario, pitch
        self._client = VirtualClient(world=SEEN, scale=GUI_SCALE)
        self._client.game.hides_hud = True
        self._arena = built_arena(self._client.realm.world, scenario)

    def of(self, cell: Cell, placed: frozenset[Cell]) -> bytes:
        """The picture of an agent that stands in a cell."""
        client, arena = self._client, self._arena
        low, high = arena.region
        client.realm.world.fill(low, high, "air")
        for each in placed:
            client.realm.world.put(arena.block_of(each), MATERIAL)
        client.realm.player.go_to(arena.centre_of(cell))
        client.realm.player.look(arena.yaw, self._pitch)
        client.clock.sleep(0.15)
        return world_greys(client.display.grab(), Scales(GUI_SCALE, GUI_SCALE)).tobytes()


def square_of(size: int) -> Scenario:
    """A scenario of that size: five blocks, 30 steps, from the middle of the near edge."""
    design = frozenset((x, size // 2) for x in range(5))
    return Scenario("bench", design, (size // 2, 0), 30, (Material(MATERIAL, 1.0, MATERIAL),), size)


def walk(scenario: Scenario, steps: int, rng: np.random.Generator) -> Iterator[tuple[Cell, frozenset[Cell], bool]]:
    """Where the agent stands and what was placed, step by step, and whether an episode begins there."""
    cell, placed, age = scenario.start, frozenset[Cell](), 0
    for _ in range(steps):
        yield cell, placed, age == 0
        action = Action(int(rng.choice(list(_possible(cell, placed, scenario.size)))))
        cell = rules.moved(cell, action, placed, scenario.size)
        landing = rules.landing(cell, action, placed, scenario.size)
        placed, age = placed | ({landing} if landing else set()), age + 1
        if age == scenario.step_limit or len(placed) == scenario.blocks:
            cell, placed, age = scenario.start, frozenset(), 0


def _possible(cell: Cell, placed: frozenset[Cell], size: int) -> Iterator[int]:
    for action in Action:
        target = rules.moved(cell, action, placed, size)
        if target != cell or rules.landing(target, action, placed, size):
            yield int(action)


def share_alike(seen: Iterable[tuple[Hashable, State]]) -> float:
    """The share of looks that occur in more than one state."""
    states = defaultdict(set)
    looks = list(seen)
    for look, state in looks:
        states[look].add(state)
    return sum(len(states[look]) > 1 for look, _ in looks) / len(looks)


def in_view(size: int, pitch: float) -> list[float]:
    """The share of an empty arena's cells whose middle is in the picture, for each row; the mean over its columns."""
    camera = projection(854, 480) @ view((0.0, EYE, 0.0), 0.0, pitch)
    cells = [(x, y) for y in range(size) for x in range(size)]

    def shows(cell: Cell, stood: Cell) -> bool:
        x, y, _, ahead = camera @ np.array((stood[0] - cell[0], 0.0, cell[1] - stood[1], 1.0))
        return bool(ahead > 0 and max(abs(x), abs(y)) <= ahead)

    shares = [float(np.mean([shows(cell, stood) for cell in cells])) for stood in cells]
    return [round(math.fsum(shares[row * size : (row + 1) * size]) / size, 3) for row in range(size)]


def measure(size: int, pitch: float, steps: int, seed: int) -> dict[str, Any]:
    """The figures of one size."""
    scenario = square_of(size)
    pictured = Pictured(scenario, pitch)
    alone = {pictured.of((x, y), frozenset()) for x in range(size) for y in range(size)}
    single: list[tuple[Hashable, State]] = []
    four: list[tuple[Hashable, State]] = []
    last: deque[bytes] = deque(maxlen=FRAMES)
    for cell, placed, begins in walk(scenario, steps, np.random.default_rng(seed)):
        picture = pictured.of(cell, placed)
        last.extend([picture] * (FRAMES if begins else 1))
        state = (*cell, scenario.blocks - len(placed))
        single.append((picture, state))
        four.append((tuple(last), state))
    return {
        "size": size,
        "pitch": pitch,
        "cells": size * size,
        "cells_seen": len(alone),
        "states": len({state for _, state in single}),
        "alike_1": round(share_alike(single), 3),
        "alike_4": round(share_alike(four), 3),
        "in_view": in_view(size, pitch),
    }


def main() -> int:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(description="How much of where an agent stands its window shows.")
    parser.add_argument("--steps", type=int, default=2000, help="of each random walk")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--pitch", type=float, default=PITCH, help="degrees that the agent looks down")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    found = [measure(size, arguments.pitch, arguments.steps, arguments.seed) for size in SIZES]
    if arguments.json:
        print(json.dumps(found))
        return 0
    for figures in found:
        print("  ".join(f"{name} {value}" for name, value in figures.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
