"""What a person did in the arena, as the agent's actions: cells walked through, and a block in front of the last.

What no action can say raises LiveError, one line: a block of another kind or elsewhere, one that was broken, and a
place that the agent can't walk to.
"""

import math
from collections.abc import Collection, Mapping, Sequence

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import way_to
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import WITH_BLOCK, front_of, is_inside, moved
from mc_nested.errors import LiveError, ScenarioError
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.model.reading import Block, Target
from mc_nested.live.profile.arena import Arena


def outcomes_of(walk: Sequence[Cell], block: Cell | None, built: Collection[Cell], size: int) -> list[Outcome]:
    """Return a walk from its first cell through the others as outcomes of actions; with a block, the last places it.

    Only a move places a block: where there was none, as when a person turned, one away and back is taken for it.

    Args:
        walk: the cells, which need not be neighbours.
        block: the cell in front of the last one, if a block was placed there.
        built: the cells that held a block before.
        size: the arena's.
    """
    done: list[tuple[Cell, Action]] = []
    cell = walk[0]
    for goal in walk[1:] or ([cell] if block else []):
        try:
            way = way_to(cell, goal, built, size)
        except ScenarioError:
            raise LiveError(f"you are at {goal}, where nobody can walk from {cell}: stay on the floor") from None
        for action in way:
            cell = moved(cell, action, built, size)
            done.append((cell, action))
    outcomes = [Outcome(cell, None, action) for cell, action in done]
    if block is not None:
        cell, action = done[-1]
        outcomes[-1] = Outcome(cell, block, WITH_BLOCK[action])
    return outcomes


def placed_from(walk: Sequence[Cell], block: Cell) -> int:
    """Return from which place of a walk a block was placed in front: the last that fits."""
    for place in reversed(range(len(walk))):
        if front_of(walk[place]) == block:
            return place
    raise LiveError(f"a block was placed at {block}, not in front of you at {walk[-1]}: stand behind its cell")


def new_block(target: Target | None, arena: Arena, built: Mapping[Cell, str], shown_id: str, size: int) -> Cell | None:
    """Return the cell of a block that is looked at and wasn't known before; None if there is no such.

    Args:
        target: the block looked at.
        arena: where it lies in the world.
        built: the cells that are known to hold a block, and its id.
        shown_id: the id of the block in hand.
        size: the number of cells along each side of the scenario's arena.
    """
    if target is None or target.pos is None or target.id is None:
        return None
    cell, level = cell_of(target.pos, arena)
    if not is_inside(cell, size):
        return None
    if level < -1:
        raise LiveError(f"the floor at {cell} was broken: leave it whole")
    if level == -1 and cell in built:
        raise LiveError(broken(cell))
    if level == 1:
        raise LiveError(f"a block stands at {cell} above the ground: place blocks on the floor alone")
    if level != 0 or built.get(cell) == target.id:
        return None
    if target.id != shown_id:
        raise LiveError(f"{target.id} was placed at {cell}, not {shown_id}: take that in hand")
    return cell


def broken(cell: Cell) -> str:
    """Say that a block was broken, which no action does."""
    return f"the block at {cell} was broken, which the agent can't do: leave blocks where they are"


def cell_of(block: Block, arena: Arena) -> tuple[Cell, int]:
    """Return the cell that a block is in, and how many blocks above the floor's top it lies; the floor itself at -1."""
    x, y, z = block
    return cell_at(arena.position_of((x + 0.5, y, z + 0.5))), math.floor(y - arena.origin[1])
