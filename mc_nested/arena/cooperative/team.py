"""Team: one scenario, built by k builders at once, each from a start cell of its own; their game and its rules.

All builders act at the same tick. Their actions are resolved one after the other, by builder number: first the
whole action of builder 0, its move and then its block, then that of builder 1 in the arena as 0 left it, and so on. A
builder is as solid as a block: nobody moves into its cell, and no block lands on it. The blocks left are the team's:
once none is left, an action with +D only moves. None instead of an action does nothing.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Protocol

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome, Resumable
from mc_nested.arena.rules import is_inside, landing, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import ScenarioError

MOST_BUILDERS = 4
"""Builders in one arena at most."""


@dataclass(frozen=True)
class Team:
    """A scenario and the start cell of each builder, in the order of their numbers.

    ScenarioError if there are none or too many, one starts outside, or two start on one cell.
    """

    scenario: Scenario
    starts: tuple[Cell, ...]

    def __post_init__(self) -> None:
        _check_number(len(self.starts))
        if self.scenario.parts:
            raise ScenarioError(f"scenario {self.scenario.name} has parts: several builders take one without")
        size = self.scenario.size
        for number, start in enumerate(self.starts):
            if not is_inside(start, size):
                raise ScenarioError(f"builder {number} starts on {start}, outside: choose 0 to {size - 1} for x and y")
            first = self.starts.index(start)
            if first != number:
                raise ScenarioError(
                    f"builders {first} and {number} both start on cell {start}: give each a cell of its own"
                )

    @property
    def builders(self) -> int:
        """How many builders there are."""
        return len(self.starts)


class TeamGame(Protocol):
    """An arena that k builders build in. A game is made for one Team.

    A live game raises LiveError when a builder can't do what was asked; the arena has to be reset then.
    """

    @property
    def resumable(self) -> Resumable | None:
        """The game, if its episode can be saved half-way; None if not."""

    def reset(self, material: int) -> tuple[Cell, ...]:
        """Clear the arena, put each builder on its start cell with the material in hand; return those cells."""

    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        """Do one tick, an action or None for each builder (``resolved``), and say what happened, by number."""


def team_of(scenario: Scenario, builders: int) -> Team:
    """Return a team of that many builders, spread over the arena; ScenarioError if there can't be so many."""
    return Team(scenario, spread_starts(scenario, builders))


def spread_starts(scenario: Scenario, builders: int) -> tuple[Cell, ...]:
    """Return the scenario's start for builder 0; the others as far apart along its row, which goes on at the other end.

    ScenarioError if there can't be so many.
    """
    _check_number(builders)
    x, y = scenario.start
    return tuple(((x + number * scenario.size // builders) % scenario.size, y) for number in range(builders))


def _check_number(builders: int) -> None:
    if not 1 <= builders <= MOST_BUILDERS:
        raise ScenarioError(f"{builders} builders: an arena takes 1 to {MOST_BUILDERS}")


MOVE_OF = {Action.FD: Action.F, Action.LD: Action.L, Action.RD: Action.R, Action.BD: Action.B}
"""The move of each action that places a block."""


def others_of(cells: Sequence[Cell], builder: int) -> frozenset[Cell]:
    """Return the cells that the other builders stand in."""
    return frozenset(cells[:builder]) | frozenset(cells[builder + 1 :])


def action_with(action: Action, blocks_left: int) -> Action:
    """Return what an action comes to with so many blocks left: without any, its move alone."""
    return action if blocks_left else MOVE_OF.get(action, action)


def resolved(
    cells: Sequence[Cell], placed: Collection[Cell], actions: Sequence[Action | None], size: int, blocks_left: int
) -> tuple[Outcome, ...]:
    """Return what one tick leads to, by builder number.

    Args:
        cells: where each builder stands before it.
        placed: the cells that hold a block before it.
        actions: what each builder does.
        size: cells along each side of the arena.
        blocks_left: how many blocks the team still has.
    """
    standing, blocks = list(cells), set(placed)
    outcomes = []
    for builder, wanted in enumerate(actions):
        if wanted is None:
            outcomes.append(Outcome(standing[builder], None))
            continue
        action = action_with(wanted, blocks_left)
        solid = blocks | others_of(standing, builder)
        cell = moved(standing[builder], action, solid, size)
        block = landing(cell, action, solid, size)
        standing[builder] = cell
        if block is not None:
            blocks.add(block)
            blocks_left -= 1
        outcomes.append(Outcome(cell, block))
    return tuple(outcomes)
