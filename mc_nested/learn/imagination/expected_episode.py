"""What an episode is expected to do: a policy, played out in the learnt game."""

from collections.abc import Callable

from mc_nested.arena.action import Cell
from mc_nested.learn.imagination.arena_step import NOWHERE, ImaginedArena, cell_at, index_of, step
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.first_tries import FirstTries

State = tuple[int, int, int]
"""x, y and the blocks left."""


def expected_landings(
    arena: ImaginedArena, start: State, step_limit: int, policy: Callable[[State], int], tries: FirstTries
) -> list[Cell]:
    """Where the blocks of an episode should land, in order. ``tries`` come before the policy, and count what it does.

    Args:
        arena: the learnt game.
        start: the state after a reset.
        step_limit: steps of an episode at most.
        policy: the action in a state.
        tries: of a plan's own, since it is changed.
    """
    seen = Experience()
    seen.begin()
    solid = arena.empty.copy()
    (x, y, blocks), position = start, index_of(start[:2], arena)
    landings: list[Cell] = []
    for _ in range(step_limit):
        if blocks == 0:
            break
        action = tries.act(policy((x, y, blocks)), seen.tried_here())
        position, landed = step(arena, position, action, solid)
        next_x, next_y = cell_at(position, arena)
        tries.observe(action, (next_x, next_y) != (x, y), seen.tried_here())
        left = blocks - (landed != NOWHERE)
        seen.add(RealStep(x, y, blocks, action, next_x, next_y, left, 0, 0))
        if landed != NOWHERE:
            landings.append(cell_at(landed, arena))
        x, y, blocks = next_x, next_y, left
    return landings
