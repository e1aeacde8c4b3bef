"""Double deep Q-learning in the learnt game, compiled: play an imagined step, store it, update from a batch.

An imagined episode is played by the network or by the table (table_learner.py); the network learns from both. Its
targets add up a few rewards in a row, whoever chose the actions between (n-step returns, uncorrected; Hessel et al.,
2018): the episodes near a policy that builds are most, and their returns are true whichever cells the state hides.

What a transition is paid isn't stored, but the cell where its block landed: the real transitions of earlier episodes,
which are in the same replay, are paid by today's beliefs.
"""

from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Bools, Float32s, Float64s, Int64s, Integers
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.adam import adam_step
from mc_nested.learn.dqn.compiled_engine.cell_networks import (
    CellPasses,
    backward_cells,
    by_input,
    by_node,
    forward_cells,
)
from mc_nested.learn.dqn.compiled_engine.engine import Networks, greedy_actions, td_target
from mc_nested.learn.imagination.arena_step import (
    GREEDY_EVERY,
    NOWHERE,
    ImaginedArena,
    ImaginedTask,
    epsilon_from,
    is_wasted,
    state_at,
    step,
)


class PracticeRule(NamedTuple):
    """Hyper-parameters: those of an update (engine.py), and the highest and the lowest ε of an imagined episode.

    ``double``: the online network chooses the action of s' that the target network values, not the target network.
    ``n_steps``: how many rewards in a row a target adds up before the value of the state that follows.
    ``by_table``: the share of imagined episodes whose actions the table chooses (table_learner.py).
    """

    gamma: float
    learning_rate: float
    target_period: int
    huber_delta: float
    learning_starts: int
    highest_epsilon: float
    lowest_epsilon: float
    double: bool
    n_steps: int
    by_table: float


class PracticeReplay(NamedTuple):
    """Transitions (capacity,): indices of s and s', action, cell of the landed block, whether it terminated.

    ``added`` (1,) counts what was ever added; the oldest is overwritten.
    """

    states: Integers
    next_states: Integers
    actions: Integers
    landed: Integers
    terminated: Bools
    added: Int64s


class Workspace(NamedTuple):
    """Arrays that are reused: ``sizes`` of the networks, ``numbers`` (cell_networks.py), passes of 1 and of a batch.

    ``seen_in`` (states,) is the episode in which each state was last seen, ``table`` (states, actions) are the table's
    values.
    """

    sizes: Int64s
    numbers: Float32s
    acting: CellPasses
    batch: CellPasses
    next_batch: CellPasses
    scratch: CellPasses
    slope: Float32s
    gradient: Float32s
    seen_in: Int64s
    table: Float32s


class Progress(NamedTuple):
    """What practice has come to, (1,) each: imagined episodes, the best greedy score, whether that is the aim.

    ``best`` (parameters,) is the online network that scored it, the last one of several.
    """

    episodes: Int64s
    best_score: Float64s
    reached: Bools
    best: Float32s


@compiled(nogil=True)
def practise(
    uniforms: Float64s,
    arena: ImaginedArena,
    task: ImaginedTask,
    rule: PracticeRule,
    row: Networks,
    replay: PracticeReplay,
    work: Workspace,
    progress: Progress,
) -> None:
    """Practise until the greedy policy reaches the aim, or the numbers in [0, 1) don't suffice for another episode.

    A greedy episode comes first, and then every GREEDY_EVERY episodes. The others are ε-greedy by the network or by the
    table, with an ε of their own between the highest and the lowest, equally likely on a logarithmic scale: some wander
    widely, most stay near the policy. They end where a block is wasted. Where an episode comes to a state again, a
    policy would go round for ever: a greedy episode ends there, another goes on by chance.
    """
    _order(row, progress.best, work.sizes, for_cells=True)
    batch = work.batch.values.shape[1]
    longest = 2 + task.step_limit * (2 + batch)
    used = 0
    solid = arena.empty.copy()
    while used + longest <= len(uniforms) and not progress.reached[0]:
        greedy = progress.episodes[0] % GREEDY_EVERY == 0
        epsilon, by_table = 0.0, False
        if not greedy:
            epsilon = epsilon_from(uniforms[used], rule.highest_epsilon, rule.lowest_epsilon)
            by_table = uniforms[used + 1] < rule.by_table
            used += 2
        solid[:] = arena.empty
        position, blocks, steps, score, wasted = task.start, task.blocks, 0, 0.0, False
        episode = progress.episodes[0]
        state = state_at(position, blocks, arena, task)
        while blocks > 0 and steps < task.step_limit and not wasted:
            been_here = work.seen_in[state] == episode
            if greedy and been_here:
                break
            action = int(np.argmax(work.table[state])) if by_table else _greedy_action(row.online, state, work)
            if not greedy:
                action = (
                    int(uniforms[used + 1] * len(arena.moves)) if uniforms[used] < max(epsilon, been_here) else action
                )
                used += 2
            work.seen_in[state] = episode
            position, landed = step(arena, position, action, solid)
            if landed != NOWHERE:
                blocks -= 1
                score += arena.pay[landed]
                wasted = not greedy and is_wasted(landed, arena)
            next_state = state_at(position, blocks, arena, task)
            steps += 1
            if not greedy:
                _store(replay, state, next_state, action, landed, blocks == 0)
                if replay.added[0] >= rule.learning_starts:
                    _update(uniforms[used : used + batch], arena, rule, row, replay, work)
                    used += batch
            state = next_state
        progress.episodes[0] += 1
        if greedy:
            _judge(score, task.aim, row.online, progress)
    _order(row, progress.best, work.sizes, for_cells=False)


@compiled(nogil=True)
def _order(row: Networks, best: Float32s, sizes: Int64s, for_cells: bool) -> None:
    """Order the first layers' weights for the passes of cell_networks.py, or back."""
    for parameters in (row.online, row.target, row.first_moment, row.second_moment, best):
        if for_cells:
            by_input(parameters, sizes)
        else:
            by_node(parameters, sizes)


@compiled(nogil=True)
def _judge(score: float, aim: float, online: Float32s, progress: Progress) -> None:
    progress.reached[0] = score >= aim
    if score >= progress.best_score[0]:
        progress.best_score[0] = score
        progress.best[:] = online


@compiled(nogil=True)
def _greedy_action(online: Float32s, state: int, work: Workspace) -> int:
    states = np.empty(1, np.int64)
    states[0] = state
    forward_cells(online, work.sizes, states, work.numbers, work.acting)
    return int(np.argmax(work.acting.values[:, 0]))


@compiled(nogil=True)
def _store(replay: PracticeReplay, state: int, next_state: int, action: int, landed: int, terminated: bool) -> None:
    at = replay.added[0] % len(replay.states)
    replay.states[at], replay.next_states[at] = state, next_state
    replay.actions[at], replay.landed[at], replay.terminated[at] = action, landed, terminated
    replay.added[0] += 1


@compiled(nogil=True)
def _update(
    uniforms: Float64s, arena: ImaginedArena, rule: PracticeRule, row: Networks, replay: PracticeReplay, work: Workspace
) -> None:
    """Do one double-Q update (paper, equation 4) from a batch that the numbers (batch,) draw."""
    batch = len(uniforms)
    held = min(replay.added[0], len(replay.states))
    drawn = np.empty(batch, np.int64)
    states, next_states = np.empty(batch, np.int64), np.empty(batch, np.int64)
    rewards, discounts = np.empty(batch), np.empty(batch)
    for column in range(batch):
        drawn[column] = min(int(uniforms[column] * held), held - 1)
        last, rewards[column], discounts[column] = followed(replay, drawn[column], arena, rule)
        states[column], next_states[column] = replay.states[drawn[column]], replay.next_states[last]
    # The target network's values go through the workspace of s, which is overwritten by those of s afterwards.
    forward_cells(row.online, work.sizes, next_states, work.numbers, work.next_batch)
    forward_cells(row.target, work.sizes, next_states, work.numbers, work.batch)
    targets = np.empty(batch, np.float32)
    chooser = work.next_batch.values if rule.double else work.batch.values
    greedy = np.empty(batch, np.int32)
    greedy_actions(chooser, greedy)
    for column in range(batch):
        next_value = work.batch.values[greedy[column], column]
        targets[column] = td_target(rewards[column], discounts[column], next_value)
    forward_cells(row.online, work.sizes, states, work.numbers, work.batch)
    work.slope[:] = np.float32(0)
    for column in range(batch):
        action = replay.actions[drawn[column]]
        error = work.batch.values[action, column] - targets[column]
        work.slope[action, column] = min(max(error, -rule.huber_delta), rule.huber_delta) / batch
    backward_cells(row.online, work.sizes, states, work.numbers, work.batch, work.slope, work.gradient, work.scratch)
    row.updates[0] += 1
    adam_step(row.online, row.first_moment, row.second_moment, work.gradient, row.updates[0], rule.learning_rate)
    if row.updates[0] % rule.target_period == 0:
        row.target[:] = row.online


@compiled(nogil=True)
def followed(replay: PracticeReplay, first: int, arena: ImaginedArena, rule: PracticeRule) -> tuple[int, float, float]:
    """Return the transition up to n steps later, the discounted rewards until then, and the next value's factor.

    It ends earlier where the episode does, where a block is wasted, or where what followed isn't held.
    """
    held = min(replay.added[0], len(replay.states))
    next_added = replay.added[0] % len(replay.states)
    at, rewards, discount = first, 0.0, 1.0
    for further in range(rule.n_steps):
        rewards += discount * arena.pay[replay.landed[at]]
        discount *= rule.gamma
        if replay.terminated[at] or is_wasted(replay.landed[at], arena):
            return at, rewards, 0.0
        following = (at + 1) % len(replay.states)
        is_held = following < held and following != next_added
        if further + 1 == rule.n_steps or not is_held or replay.states[following] != replay.next_states[at]:
            break
        at = following
    return at, rewards, discount
