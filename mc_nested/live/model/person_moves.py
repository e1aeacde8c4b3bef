"""What a person did in the arena, as the agent's actions: cells walked through, and a block in front of the last.

What no action can say raises LiveError, one line: a block of another kind or elsewhere, one that was broken, and a
place that the agent can't walk to.
"""

from collections.abc import Collection, Mapping, Sequence

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import way_to
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import WITH_BLOCK, front_of, is_inside, moved
from mc_nested.errors import LiveError, ScenarioError


def outcomes_of(walk: Sequence[Cell], block: Cell | None, built: Collection[Cell], size: int) -> list[Outcome]:
    """Return a walk from its first cell through the others as outcomes of actions; with a block, the last places it.

    The cells need not be neighbours; ``block`` is the one in front of the last, ``built`` those that held one before.
    Only a move places a block: where there was none, as when a person turned, one away and back is taken for it.
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


def new_block(cell: Cell, level: int, name: str, built: Mapping[Cell, str], shown_id: str, size: int) -> Cell | None:
    """Return the cell of a block that is looked at and wasn't known before; None if this one was.

    It lies in ``cell``, at level 0 on the floor, which is at -1 itself; its id is ``name``, and ``shown_id`` that of
    the block in hand. ``built`` are the cells that are known to hold a block, with its id.
    """
    if not is_inside(cell, size) or (built.get(cell) == name and level == 0):
        return None
    if level < -1:
        raise LiveError(f"the floor at {cell} was broken: leave it whole")
    if level == -1 and cell in built:
        raise LiveError(broken(cell))
    if level == 1:
        raise LiveError(f"a block stands at {cell} above the ground: place blocks on the floor alone")
    if level == 0 and (cell in built or name != shown_id):
        raise LiveError(f"{name} was placed at {cell}, not {built.get(cell, shown_id)}: take that in hand")
    return cell if level == 0 else None


def broken(cell: Cell) -> str:
    """Say that a block was broken, which no action does."""
    return f"the block at {cell} was broken, which the agent can't do: leave blocks where they are"
