"""The compiled practice: its updates are those of DDQN, paid by today's beliefs, by numbers used in order."""

import numpy as np
import pytest

from mc_nested.arrays import Float32s, Float64s
from mc_nested.learn.dqn.compiled_engine.engine import compiled_engine
from mc_nested.learn.dqn.engine import Batch
from mc_nested.learn.dqn.states import numbered
from mc_nested.learn.imagination.arena_step import GREEDY_EVERY, NOWHERE, ImaginedArena, ImaginedTask, cell_at, index_of
from mc_nested.learn.imagination.practice_kernel import PracticeReplay, Progress, followed, practise
from mc_nested.learn.imagination.practice_session import NetworkPractice
from mc_nested.learn.learner import Learner
from tests.learn.imagination.made_games import BENT, RULE, SMALL, with_update
from tests.learn.imagination.made_practice import MATERIAL, arena_of, learner_of, real_of

BATCH = SMALL.update.batch
GAMMA = SMALL.update.gamma


class Practising:
    """One learner's practice in the kernel, with given random numbers."""

    def __init__(
        self, learner: Learner, step_limit: int, learning_starts: int = 1, target_period: int = 1000, n_steps: int = 1
    ) -> None:
        preset = with_update(SMALL, learning_starts=learning_starts, target_period=target_period)
        practice = NetworkPractice(learner, preset, RULE.model_copy(update={"n_steps": n_steps}))
        self.arena, space = arena_of(), numbered(learner.states)
        strides = space.strides
        offset = int(MATERIAL @ strides[3:])
        # An aim that is out of reach, and blocks that outlast every episode.
        start = index_of(BENT.start, self.arena)
        self.task = ImaginedTask(start, BENT.blocks, step_limit, 99.0, strides[:3], offset)
        self.rule, self.replay, self.work = (
            practice._rule._replace(by_table=0.0),
            practice._replay,
            practice._workspaces[0]._replace(table=np.zeros((space.count, space.actions), np.float32)),
        )
        self.row = compiled_engine(learner.engine).row(0)
        self.progress = Progress(np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_), self.row.online.copy())

    @property
    def longest(self) -> int:
        """How many numbers an episode can use."""
        return 2 + self.task.step_limit * (2 + BATCH)

    def go(self, numbers: Float64s, arena: ImaginedArena | None = None) -> None:
        known = self.arena if arena is None else arena
        practise(numbers, known, self.task, self.rule, self.row, self.replay, self.work, self.progress)


def paid_everywhere(arena: ImaginedArena) -> ImaginedArena:
    """Return that arena with pay for every cell, so that no block is wasted."""
    return arena._replace(pay=np.ones_like(arena.pay))


def batch_of(replay: PracticeReplay, held: int, uniforms: Float64s, pay: Float32s) -> Batch:
    """Return the batch that these numbers draw from the first transitions."""
    drawn = (uniforms * held).astype(np.int64)
    states = np.stack((replay.states[drawn], replay.next_states[drawn])).astype(np.int64)
    wasted = (replay.landed[drawn] != NOWHERE) & (pay[replay.landed[drawn]] == 0)
    discounts = np.where(replay.terminated[drawn] | wasted, 0.0, GAMMA).astype(np.float32)
    return Batch(
        states=states[:, None],
        actions=replay.actions[drawn].astype(np.int64)[None],
        rewards=pay[replay.landed[drawn]][None],
        discounts=discounts[None],
        imitated=np.zeros((1, BATCH), np.bool_),
        weights=np.ones((1, BATCH), np.float32),
    )


@pytest.mark.parametrize(("steps", "target_period"), [(1, 1000), (1, 1), (10, 3)])
def test_kernel_updates_match_the_engines_ddqn_updates_on_the_same_batches(steps: int, target_period: int) -> None:
    ours, theirs = learner_of(), learner_of()
    compiled_engine(theirs.engine).rule = theirs.engine.rule._replace(target_period=target_period)
    at = Practising(ours, steps, target_period=target_period)
    for transition in range(200):  # real ones, of which some terminated and some were paid
        random = np.random.default_rng(transition)
        at.replay.states[transition], at.replay.next_states[transition] = random.integers(0, ours.states.highest, 2)
        at.replay.actions[transition] = random.integers(0, 8)
        landed = random.choice([index_of(cell, at.arena) for cell in [(2, 3), (3, 3), (0, 1), (4, 4)]])
        at.replay.landed[transition] = landed
        at.replay.terminated[transition] = random.random() < 0.3
    at.replay.added[0] = 200

    numbers = np.random.default_rng(9).random(at.longest)
    numbers[0] = 0.0  # the lowest ε
    numbers[2 + np.arange(steps) * (2 + BATCH)] = 0.99  # no step is by chance
    at.go(numbers)
    assert at.progress.episodes.tolist() == [2], "a greedy one, and one with updates"
    done = int(at.replay.added[0]) - 200
    assert int(at.row.updates[0]) == done >= (1 if steps == 1 else 5)
    for update in range(done):
        first = 2 + update * (2 + BATCH) + 2
        batch = batch_of(at.replay, 201 + update, numbers[first : first + BATCH], at.arena.pay)
        theirs.engine.update(np.array([0]), batch)
    np.testing.assert_allclose(ours.engine.online, theirs.engine.online, rtol=1e-3, atol=2e-5)
    np.testing.assert_allclose(ours.engine.target, theirs.engine.target, rtol=1e-3, atol=2e-5)
    assert (ours.engine.target == ours.engine.online).all() == (done % target_period == 0)
    for one, other in zip(*(compiled_engine(each.engine).row(0)[2:4] for each in (ours, theirs)), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-3, atol=1e-6)


def test_a_real_transition_is_paid_by_the_current_beliefs() -> None:
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
        values.append(learner.engine.q_values(real.states)[0, 4])
    np.testing.assert_allclose(values, [1.0, 0.0], atol=0.1)


def test_updates_begin_once_there_are_enough_transitions() -> None:
    at = Practising(learner_of(), 4, learning_starts=6)
    at.go(np.full(at.longest, 0.99))
    assert (int(at.replay.added[0]), int(at.row.updates[0])) == (4, 0)
    at.progress.episodes[0] = GREEDY_EVERY + 1
    at.go(np.full(at.longest, 0.99))
    assert (int(at.replay.added[0]), int(at.row.updates[0])) == (8, 3), "at the sixth, the seventh and the eighth"


def test_random_numbers_too_few_for_an_episode_are_not_used() -> None:
    at = Practising(learner_of(), 3)
    at.go(np.zeros(at.longest - 1))
    assert (at.progress.episodes[0], at.replay.added[0], at.row.updates[0]) == (0, 0, 0)


def test_a_regular_share_of_episodes_is_greedy_and_stores_nothing() -> None:
    at = Practising(learner_of(), 2)
    at.go(np.random.default_rng(0).random(40 * at.longest), paid_everywhere(at.arena))
    episodes = int(at.progress.episodes[0])
    assert episodes >= 40
    greedy = -(-episodes // GREEDY_EVERY)
    assert int(at.replay.added[0]) == int(at.row.updates[0]) == 2 * (episodes - greedy)


def test_the_highest_epsilon_makes_every_step_random_with_actions_picked_by_numbers() -> None:
    at = Practising(learner_of(), 4, learning_starts=10**6)
    numbers = np.concatenate(([1 - 1e-12], np.tile([0.5], at.longest - 1)))
    numbers[[3, 5, 7, 9]] = [4 / 8, 0.0, 6 / 8, 1 - 1e-12]  # FD, F, RD, BD
    at.go(numbers, paid_everywhere(at.arena))
    assert at.replay.actions[:4].tolist() == [4, 0, 6, 7]
    # FD from (2, 1) places in (2, 3); F is stopped; RD places in (3, 3); BD goes back to (3, 1) and places in (3, 2).
    landed = [int(cell) for cell in at.replay.landed[:4]]
    assert landed[1] == 0
    assert [cell_at(landed[step], at.arena) for step in (0, 2, 3)] == [(2, 3), (3, 3), (3, 2)]
    assert at.replay.terminated[:4].tolist() == [False, False, False, True]


def test_a_full_practice_replay_overwrites_its_oldest_transition() -> None:
    at = Practising(learner_of(), 4, learning_starts=10**6)
    room = at.replay._replace(
        **{name: part[:3].copy() for name, part in at.replay._asdict().items() if name != "added"}
    )
    at.replay = room
    at.go(np.full(at.longest, 0.99))
    assert room.added.tolist() == [4]
    assert room.states[0] == room.next_states[2], "the fourth lies where the first was"


def held(landed: list[tuple[int, int] | None], capacity: int, n_steps: int = 3) -> tuple[Practising, PracticeReplay]:
    """Return a kernel, and its replay with one episode, whose blocks landed in these cells.

    State 10 comes first, then 11…
    """
    at = Practising(learner_of(), 1, n_steps=n_steps)
    cells = [index_of(cell, at.arena) if cell else NOWHERE for cell in landed]
    replay = at.replay._replace(
        **{name: part[:capacity].copy() for name, part in at.replay._asdict().items() if name != "added"}
    )
    for step, cell in enumerate(cells):
        replay.states[step % capacity], replay.next_states[step % capacity] = 10 + step, 11 + step
        replay.landed[step % capacity] = cell
        replay.terminated[step % capacity] = False
    replay.added[0] = len(cells)
    return at, replay


PAID, UNPAID = (2, 3), (0, 1)


def test_a_target_adds_up_the_rewards_of_n_steps_and_the_value_after_them() -> None:
    at, replay = held([None, PAID, PAID, PAID], 100)
    last, rewards, discount = followed(replay, 0, at.arena, at.rule)
    assert (last, rewards, discount) == pytest.approx((2, GAMMA + GAMMA**2, GAMMA**3))
    one_step = at.rule._replace(n_steps=1)
    assert followed(replay, 1, at.arena, one_step) == pytest.approx((1, 1.0, GAMMA))


def test_a_target_ends_with_the_episode_or_at_a_wasted_block() -> None:
    at, replay = held([PAID, PAID, PAID], 100)
    replay.terminated[1] = True
    assert followed(replay, 0, at.arena, at.rule) == pytest.approx((1, 1 + GAMMA, 0.0))
    at, replay = held([PAID, UNPAID, PAID], 100)
    assert followed(replay, 0, at.arena, at.rule) == pytest.approx((1, 1.0, 0.0))


def test_a_target_ends_at_the_last_held_transition_of_its_episode() -> None:
    at, replay = held([PAID, PAID], 100)
    assert followed(replay, 1, at.arena, at.rule) == pytest.approx((1, 1.0, GAMMA)), "the newest transition"
    replay.states[1] = 55
    assert followed(replay, 0, at.arena, at.rule) == pytest.approx((0, 1.0, GAMMA)), "another episode follows"
    at, replay = held([PAID] * 5, 3)  # the fourth and fifth lie where the first and second were
    assert followed(replay, 2, at.arena, at.rule)[0] == 1
    assert followed(replay, 1, at.arena, at.rule) == pytest.approx((1, 1.0, GAMMA)), "the oldest follows in its place"


def test_a_low_number_lets_the_table_choose_the_episodes_actions() -> None:
    at = Practising(learner_of(), 2, learning_starts=10**6)
    at.work.table[:, 2] = 1.0  # L everywhere, and nothing explored
    at.rule = at.rule._replace(by_table=0.5, highest_epsilon=1e-9, lowest_epsilon=1e-9)
    numbers = np.full(at.longest, 0.9)
    numbers[1] = 0.49
    at.go(numbers)
    assert at.replay.actions[:2].tolist() == [2, 2]


def test_an_imagined_episode_ends_at_a_wasted_block() -> None:
    at = Practising(learner_of(), 4, learning_starts=10**6)
    at.work.table[:, 6] = 1.0  # RD: from (2, 1) to (3, 1), and a block lands in (3, 2), which isn't paid
    at.rule = at.rule._replace(by_table=1.0, highest_epsilon=1e-9, lowest_epsilon=1e-9)
    at.go(np.full(at.longest, 0.9))
    assert at.replay.added.tolist() == [1]
    assert not at.replay.terminated[0], "that it was wasted is a belief: the target asks it when it is computed"
