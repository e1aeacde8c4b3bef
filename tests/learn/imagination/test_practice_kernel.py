"""The compiled practice: its updates are those of DDQN, paid by today's beliefs, by numbers used in order."""

import numpy as np
import pytest

from mc_nested.arrays import Float32s, Float64s
from mc_nested.learn.dqn.ddqn import Batch
from mc_nested.learn.imagination.arena_step import ImaginedArena, cell_at, index_of
from mc_nested.learn.imagination.practice import Practice
from mc_nested.learn.imagination.practice_kernel import (
    GREEDY_EVERY,
    ImaginedTask,
    PracticeReplay,
    Progress,
    Row,
    practise,
)
from mc_nested.learn.learner import Learner
from tests.learn.imagination.made_games import BENT, RULE, SMALL, with_update
from tests.learn.imagination.made_practice import MATERIAL, arena_of, learner_of, real_of

BATCH = SMALL.update.batch
GAMMA = SMALL.update.gamma


class Practising:
    """One learner's practice in the kernel, by the numbers that are given."""

    def __init__(self, learner: Learner, step_limit: int, learning_starts: int = 1, target_period: int = 1000) -> None:
        preset = with_update(SMALL, learning_starts=learning_starts, target_period=target_period)
        practice = Practice(learner, preset, RULE)
        self.arena, strides = arena_of(), learner.space.strides
        offset = int(MATERIAL @ strides[3:])
        # An aim that is out of reach, and blocks that outlast every episode.
        start = index_of(BENT.start, self.arena)
        self.task = ImaginedTask(start, BENT.blocks, step_limit, 99.0, strides[:3], offset)
        self.rule, self.replay, self.work = practice._rule, practice._replay, practice._workspaces[0]
        self.row = Row(*learner.ddqn.row(0))
        self.progress = Progress(np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_))

    @property
    def longest(self) -> int:
        """How many numbers an episode can use."""
        return 1 + self.task.step_limit * (2 + BATCH)

    def go(self, numbers: Float64s, arena: ImaginedArena | None = None) -> None:
        known = self.arena if arena is None else arena
        practise(numbers, known, self.task, self.rule, self.row, self.replay, self.work, self.progress)


def batch_of(replay: PracticeReplay, held: int, uniforms: Float64s, pay: Float32s) -> Batch:
    """The batch that these numbers draw from the first transitions."""
    drawn = (uniforms * held).astype(np.int64)
    states = np.stack((replay.states[drawn], replay.next_states[drawn])).astype(np.int64)
    discounts = np.where(replay.terminated[drawn], 0.0, GAMMA).astype(np.float32)
    return Batch(
        states=states[:, None],
        actions=replay.actions[drawn].astype(np.int64)[None],
        rewards=pay[replay.landed[drawn]][None],
        discounts=discounts[None],
        imitated=np.zeros((1, BATCH), np.bool_),
        weights=np.ones((1, BATCH), np.float32),
    )


@pytest.mark.parametrize(("steps", "target_period"), [(1, 1000), (1, 1), (10, 3)])
def test_updates_are_those_of_ddqn_from_the_same_batches(steps: int, target_period: int) -> None:
    ours, theirs = learner_of(), learner_of()
    theirs.ddqn.rule = theirs.ddqn.rule._replace(target_period=target_period)
    at = Practising(ours, steps, target_period=target_period)
    for transition in range(200):  # real ones, of which some terminated and some were paid
        random = np.random.default_rng(transition)
        at.replay.states[transition], at.replay.next_states[transition] = random.integers(0, ours.space.count, 2)
        at.replay.actions[transition] = random.integers(0, 8)
        landed = random.choice([index_of(cell, at.arena) for cell in [(2, 3), (3, 3), (0, 1), (4, 4)]])
        at.replay.landed[transition] = landed
        at.replay.terminated[transition] = random.random() < 0.3
    at.replay.added[0] = 200

    numbers = np.random.default_rng(9).random(at.longest)
    numbers[0] = 0.0  # the lowest ε
    numbers[1 + np.arange(steps) * (2 + BATCH)] = 0.99  # no step is by chance
    at.go(numbers)
    assert at.progress.episodes.tolist() == [2], "a greedy one, and one with updates"
    done = int(at.replay.added[0]) - 200
    assert int(at.row.updates[0]) == done >= (1 if steps == 1 else 5)
    for update in range(done):
        first = 1 + update * (2 + BATCH) + 2
        batch = batch_of(at.replay, 201 + update, numbers[first : first + BATCH], at.arena.pay)
        theirs.ddqn.update(np.array([0]), batch)
    np.testing.assert_allclose(ours.ddqn.online, theirs.ddqn.online, rtol=1e-3, atol=2e-5)
    np.testing.assert_allclose(ours.ddqn.target, theirs.ddqn.target, rtol=1e-3, atol=2e-5)
    assert (ours.ddqn.target == ours.ddqn.online).all() == (done % target_period == 0)
    for one, other in zip(ours.ddqn.row(0)[2:4], theirs.ddqn.row(0)[2:4], strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-3, atol=1e-6)


def test_a_real_transition_is_paid_by_what_is_believed_now() -> None:
    # Two learners with the same transition and numbers: where the cell is believed to pay, the value rises more.
    values = []
    for pays in (1.0, 0.0):
        learner = learner_of()
        at = Practising(learner, 1)
        arena = at.arena._replace(pay=at.arena.pay.copy())
        arena.pay[index_of((2, 3), arena)] = pays
        real = real_of(learner, ([2, 1, 1, 1], 4, [2, 2, 0, 1], index_of((2, 3), arena)))
        for own, given in zip(at.replay, real, strict=False):
            own[:1] = given
        at.replay.added[0] = 1
        for _ in range(60):
            numbers = np.full(at.longest, 0.2)  # the older half of the replay: the real transition
            at.replay.added[0] = 1
            at.go(numbers, arena)
        values.append(learner.ddqn.q_values(real.states)[0, 4])
    np.testing.assert_allclose(values, [1.0, 0.0], atol=0.1)


def test_there_is_no_update_before_there_are_enough_transitions() -> None:
    at = Practising(learner_of(), 4, learning_starts=6)
    at.go(np.full(at.longest, 0.99))
    assert (int(at.replay.added[0]), int(at.row.updates[0])) == (4, 0)
    at.progress.episodes[0] = GREEDY_EVERY + 1
    at.go(np.full(at.longest, 0.99))
    assert (int(at.replay.added[0]), int(at.row.updates[0])) == (8, 3), "at the sixth, the seventh and the eighth"


def test_numbers_that_do_not_suffice_for_an_episode_are_not_used() -> None:
    at = Practising(learner_of(), 3)
    at.go(np.zeros(at.longest - 1))
    assert (at.progress.episodes[0], at.replay.added[0], at.row.updates[0]) == (0, 0, 0)


def test_every_so_many_episodes_one_is_greedy_and_stores_nothing() -> None:
    at = Practising(learner_of(), 2)
    at.go(np.random.default_rng(0).random(40 * at.longest))
    episodes = int(at.progress.episodes[0])
    assert episodes >= 40
    greedy = -(-episodes // GREEDY_EVERY)
    assert int(at.replay.added[0]) == int(at.row.updates[0]) == 2 * (episodes - greedy)


def test_the_highest_number_makes_every_step_one_by_chance_with_the_action_that_the_next_number_says() -> None:
    at = Practising(learner_of(), 4, learning_starts=10**6)
    numbers = np.concatenate(([1 - 1e-12], np.tile([0.5], at.longest - 1)))
    numbers[[2, 4, 6, 8]] = [4 / 8, 0.0, 6 / 8, 1 - 1e-12]  # FD, F, RD, BD
    at.go(numbers)
    assert at.replay.actions[:4].tolist() == [4, 0, 6, 7]
    # FD from (2, 1) places in (2, 3); F is stopped; RD places in (3, 3); BD goes back to (3, 1) and places in (3, 2).
    landed = [int(cell) for cell in at.replay.landed[:4]]
    assert landed[1] == 0
    assert [cell_at(landed[step], at.arena) for step in (0, 2, 3)] == [(2, 3), (3, 3), (3, 2)]
    assert at.replay.terminated[:4].tolist() == [False, False, False, True]


def test_beyond_its_capacity_the_oldest_transition_is_overwritten() -> None:
    at = Practising(learner_of(), 4, learning_starts=10**6)
    room = at.replay._replace(
        **{name: part[:3].copy() for name, part in at.replay._asdict().items() if name != "added"}
    )
    at.replay = room
    at.go(np.full(at.longest, 0.99))
    assert room.added.tolist() == [4]
    assert room.states[0] == room.next_states[2], "the fourth lies where the first was"
