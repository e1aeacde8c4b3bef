"""Hands: a person at the virtual client's own keyboard and mouse, for measuring and testing what they teach."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import way_to
from mc_nested.arena.rules import WITH_BLOCK, axis_of, front_of, is_inside, landing, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import ScenarioError
from mc_nested.live.devices import Button
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.model.kinematics import TICK_S, plan_hold
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import KeysTable, WalkTable
from sim.client.client import VirtualClient

Script = Iterator[float]
"""What the hands do: it yields the seconds to wait before it goes on."""

NEAR, PITCH = 0.15, 65.0
REST_S, CLICK_S = 0.5, 0.08
DEGREES_A_PIXEL = 0.15
KEYS, WALK = KeysTable(), WalkTable()


class Hands:
    """Presses keys and buttons on a client's desktop, as its clock goes on: never through an agent's controller.

    Args:
        client: whose keyboard and mouse they are at.
        arena: in which they play, looking its way.
    """

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        self._client, self._arena = client, arena
        self.has_done = False

    def play(self, script: Script, then: Callable[[], None] = lambda: None) -> None:
        """Begin with a script, and call ``then`` once it is done."""
        wait = next(script, None)
        if wait is None:
            self.has_done = True
            then()
            return
        clock = self._client.clock
        clock.call_at(clock.now() + wait, lambda: self.play(script, then))

    def do(self, actions: Iterable[Action]) -> Script:
        """Do the agent's actions by hand, one after the other, from where the player stands."""
        size, placed = self._arena.size, self._client.placed(self._arena)
        cell = self._client.cell(self._arena)
        for action in actions:
            cell = moved(cell, action, placed, size)
            yield from self.walk_to(cell, action)
            if block := landing(cell, action, placed, size):
                placed.add(block)
                yield from self.click()

    def settle(self) -> Script:
        """Wait until the player stands still, then walk to the middle of the cell."""
        yield REST_S
        cell = self.cell
        yield from self.walk_to(cell, Action.F)
        yield from self.walk_to(cell, Action.L)

    def walk_to(self, cell: Cell, action: Action) -> Script:
        """Hold keys until the player stands in the middle of a cell, along the axis of a move."""
        axis = axis_of(action)[0]
        while abs(off := cell[axis] - self._arena.position_of(self._client.realm.player.feet)[axis]) > NEAR:
            key = ((KEYS.left, KEYS.right), (KEYS.back, KEYS.forward))[axis][off > 0]
            plan = plan_hold(abs(off), WALK.covered, NEAR, WALK.sneaking)
            yield from self.hold(plan.ticks, *([KEYS.sneak] if plan.gait == "sneak" else []), key)

    def hold(self, ticks: int, *keys: str) -> Script:
        """Hold keys, and wait until the player stands still."""
        for key in keys:
            self._client.keyboard.press(key)
        yield ticks * TICK_S
        for key in keys:
            self._client.keyboard.release(key)
        yield REST_S

    def tap(self, key: str) -> Script:
        """Press a key for a moment."""
        yield from self.hold(1, key)

    def click(self, button: Button = "right") -> Script:
        """Click, as to place a block."""
        self._client.pointer.press(button)
        yield CLICK_S
        self._client.pointer.release(button)
        yield REST_S

    def turn(self, right: float, down: float = 0.0) -> Script:
        """Turn the view by so many degrees."""
        self._client.turn(right / DEGREES_A_PIXEL, down / DEGREES_A_PIXEL)
        yield REST_S

    @property
    def cell(self) -> Cell:
        """Where the player truly is."""
        return cell_at(self._arena.position_of(self._client.realm.player.feet))


TRIES = 100


def clumsy(scenario: Scenario, seed: int, needless: float = 0.2, wrong: int = 2) -> list[Action]:
    """Return how a person builds a design who isn't good at it, until no block is left.

    The next block is always the nearest one.

    Args:
        scenario: the design, without parts.
        seed: of what goes wrong where.
        needless: the share of needless moves among all, on average: each is made, and then taken back.
        wrong: the number of blocks beside the design.
    """
    rng = np.random.default_rng(seed)
    for _ in range(TRIES):
        try:
            actions = _clumsy(scenario, rng, needless, wrong)
        except ScenarioError:  # a block is in the way, or none fits
            continue
        if len(actions) <= scenario.step_limit:
            return actions
    raise AssertionError("each time a block was in the way, or the steps didn't suffice")


def _clumsy(scenario: Scenario, rng: np.random.Generator, needless: float, wrong: int) -> list[Action]:
    size, cell, placed, done = scenario.size, scenario.start, set[Cell](), list[Action]()
    mistakes = sorted(rng.choice(np.arange(1, scenario.blocks), wrong, replace=False).tolist())

    def do(action: Action) -> None:
        nonlocal cell
        cell = moved(cell, action, placed, size)
        if block := landing(cell, action, placed, size):
            placed.add(block)
        done.append(action)

    def free() -> list[Action]:
        return [each for each in WITH_BLOCK if moved(cell, each, placed, size) != cell]

    def beside() -> list[Action]:
        fronts = {each: front_of(moved(cell, each, placed, size)) for each in free()}
        return [
            each for each, front in fronts.items() if is_inside(front, size) and front not in placed | scenario.design
        ]

    while len(placed) < scenario.blocks:
        if mistakes and len(placed) >= mistakes[0] and (there := beside()):
            do(WITH_BLOCK[there[int(rng.integers(len(there)))]])
            del mistakes[0]
            continue
        *way, last = _nearest(cell, scenario, placed)
        for action in (*way, WITH_BLOCK[last]):
            if rng.random() < needless / (1 - needless) / 2:
                aside = free()[int(rng.integers(len(free())))]
                do(aside)
                do(_BACK[aside])
            do(action)
    if mistakes:
        raise ScenarioError("no wrong block fits any more")
    return done


def _nearest(cell: Cell, scenario: Scenario, placed: set[Cell]) -> list[Action]:
    """Return the shortest way to where a block of the design can be placed; raise ScenarioError if there is none."""
    ways = []
    for x, y in sorted(scenario.design - placed):
        with suppress(ScenarioError):
            ways.append(way_to(cell, (x, y - 1), placed, scenario.size))
    if not ways:
        raise ScenarioError("no block can be placed any more")
    return min(ways, key=len)


_BACK = {Action.F: Action.B, Action.B: Action.F, Action.L: Action.R, Action.R: Action.L}
