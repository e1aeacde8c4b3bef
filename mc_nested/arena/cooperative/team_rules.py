"""The rules for several builders in one arena: who acts first within a tick, and what stops whom.

All act at the same tick. Their actions are resolved one after the other, by builder number: each whole, the move first
and then the block, in the arena as those before it left it. A builder is as solid as a block: nobody moves into its
cell, and no block lands on it. The blocks left are the team's: once none is left, an action with +D only moves. None
instead of an action does nothing.
"""

from collections.abc import Collection, Sequence

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import landing, moved

MOVE_OF = {Action.FD: Action.F, Action.LD: Action.L, Action.RD: Action.R, Action.BD: Action.B}
"""The move of each action that places a block."""


def others_of(cells: Sequence[Cell], builder: int) -> frozenset[Cell]:
    """The cells that the other builders stand in."""
    return frozenset(cells[:builder]) | frozenset(cells[builder + 1 :])


def action_with(action: Action, blocks_left: int) -> Action:
    """What an action comes to with so many blocks left: without any, its move alone."""
    return action if blocks_left else MOVE_OF.get(action, action)


def resolved(
    cells: Sequence[Cell], placed: Collection[Cell], actions: Sequence[Action | None], size: int, blocks_left: int
) -> tuple[Outcome, ...]:
    """What one tick leads to, by builder number.

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
