"""Q-learning with a table in the learnt game, compiled: it finds its way, and the networks learn from where it goes.

A table of values, one for each state and action, learns a hundred times as fast as a network (Watkins, 1989; in a
learnt game, Sutton, 1991). It never plays the real game: it plays imagined episodes, from whose transitions the
networks learn by double Q-learning, beside their own (practice_kernel.py).

The state (x, y, b) doesn't say which cells are built, so that a value is true for one way there only. So the last
outcome counts alone (a learning rate of 1), an episode is learnt from backwards, and most episodes stay near the
policy.
"""

from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Bools, Float32s, Float64s, Int64s
from mc_nested.learn.dqn.compiled import compiled
from mc_nested.learn.imagination.arena_step import ImaginedArena, step
from mc_nested.learn.imagination.imagined_task import GREEDY_EVERY, ImaginedTask, epsilon_from, is_wasted, state_at

LATE = 0.5
"""This share of its imagined episodes follows the policy until so many blocks are left as are drawn."""


class QTable(NamedTuple):
    """The values (states, actions); the episode in which each state was last seen (states,); the last episode's steps.

    ``trail`` (3, steps + 1) has the states, actions and landed blocks' cells of that episode.
    """

    values: Float32s
    seen_in: Int64s
    trail: Int64s


class TableProgress(NamedTuple):
    """What it came to, (1,) each: imagined episodes, steps that were learnt from, whether the aim was reached."""

    episodes: Int64s
    steps: Int64s
    reached: Bools


@compiled(nogil=True)
def longest_episode(task: ImaginedTask) -> int:
    """How many numbers an episode uses at most."""
    longest: int = 3 + 2 * task.step_limit
    return longest


@compiled(nogil=True)
def learn_table(
    uniforms: Float64s,
    arena: ImaginedArena,
    task: ImaginedTask,
    gamma: float,
    highest_epsilon: float,
    lowest_epsilon: float,
    table: QTable,
    progress: TableProgress,
) -> None:
    """Learn until the greedy policy reaches the aim, or the numbers in [0, 1) don't suffice for another episode.

    Where an episode comes to a state again, a policy would go round for ever: it goes on by chance, and explores from
    there on.
    """
    used = 0
    solid = arena.empty.copy()
    while used + longest_episode(task) <= len(uniforms) and not progress.reached[0]:
        greedy = progress.episodes[0] % GREEDY_EVERY == 0
        epsilon, from_blocks = 0.0, task.blocks
        if not greedy:
            epsilon = epsilon_from(uniforms[used], highest_epsilon, lowest_epsilon)
            if uniforms[used + 1] < LATE:
                from_blocks = 1 + int(uniforms[used + 2] * task.blocks)
            used += 3
        solid[:] = arena.empty
        position, blocks, score, steps = task.start, task.blocks, 0.0, 0
        wasted = False
        state = state_at(position, blocks, arena, task)
        while blocks > 0 and steps < task.step_limit and not wasted:
            been_here = table.seen_in[state] == progress.episodes[0]
            if greedy and been_here:
                break
            table.seen_in[state] = progress.episodes[0]
            action = int(np.argmax(table.values[state]))
            if not greedy:
                if been_here:
                    from_blocks = blocks
                explores = been_here or (blocks <= from_blocks and uniforms[used] < epsilon)
                action = int(uniforms[used + 1] * len(arena.moves)) if explores else action
                used += 2
            position, landed = step(arena, position, action, solid)
            if landed:
                blocks -= 1
                score += arena.pay[landed]
                wasted = not greedy and is_wasted(landed, arena)
            table.trail[:, steps] = state, action, landed
            steps += 1
            state = state_at(position, blocks, arena, task)
        progress.episodes[0] += 1
        if greedy:
            progress.reached[0] = score >= task.aim
        else:
            progress.steps[0] += steps
            value = 0.0 if blocks == 0 or wasted else float(table.values[state].max())
            _learn_backwards(table, steps, value, arena.pay, gamma)


@compiled(nogil=True)
def _learn_backwards(table: QTable, steps: int, value: float, pay: Float32s, gamma: float) -> None:
    """Set the values of the last episode's steps, from the last to the first; ``value`` is its last state's."""
    for at in range(steps - 1, -1, -1):
        state, action, landed = table.trail[:, at]
        table.values[state, action] = pay[landed] + gamma * value
        value = float(table.values[state].max())
