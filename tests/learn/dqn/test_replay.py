"""Uniform replay: stored transitions are drawn, the oldest are overwritten, and each run draws its own."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.dqn import replay as replay_module
from mc_nested.learn.dqn.replay import Replay, Transitions
from mc_nested.learn.dqn.states import StateSpace


def transition(*numbers: int) -> Transitions:
    """Return a transition for each number, made so that every field follows from the number."""
    n = np.array(numbers)
    return Transitions(np.stack([n, n + 2]), n % 8, n / 2, n / 4)


def replay_of(runs: int, capacity: int, states: int = 200, actions: int = 8) -> Replay:
    return Replay(StateSpace(np.array([[states - 1]] * runs), actions), capacity)


def drawn_from(replay: Replay, rows: Int64s, uniforms: Float64s) -> Transitions:
    return replay.gather(rows, replay.sample(rows, uniforms))


def numbers(drawn: Transitions) -> list[list[int]]:
    """Return the numbers that drawn transitions were made of, every field checked."""
    found, following = drawn.states
    np.testing.assert_array_equal(drawn.actions, found % 8)
    np.testing.assert_array_equal(drawn.rewards, found / 2)
    np.testing.assert_array_equal(following, found + 2)
    np.testing.assert_array_equal(drawn.discounts, found / 4)
    return [[int(number) for number in row] for row in found]


def test_sample_draws_the_transitions_that_the_random_numbers_select() -> None:
    replay = replay_of(2, 10)
    for step in range(4):
        replay.add(np.array([0, 1]), transition(step, 100 + step))
    uniforms = np.array([[0.0, 0.24, 0.25, 0.5, 0.999999], [0.75, 0.0, 0.5, 0.26, 0.3]])
    assert numbers(drawn_from(replay, np.array([0, 1]), uniforms)) == [[0, 0, 1, 2, 3], [103, 100, 102, 101, 101]]


def test_bytes_held_counts_stored_transitions_and_not_spare_room() -> None:
    replay = replay_of(2, 3)
    for step in range(5):
        replay.add(np.array([0]), transition(step))
    replay.add(np.array([1]), transition(9))
    # Two indices below 256 and an action, a byte each, reward and discount, four each: 11. Run 0 is full with three.
    assert replay.bytes_held().tolist() == [33, 11]
    assert replay_of(1, 3, states=7650).bytes_held().tolist() == [0]


def test_replays_of_several_runs_fill_independently() -> None:
    replay = replay_of(3, 10)
    replay.add(np.array([2]), transition(7))
    replay.add(np.array([0, 2]), transition(8, 9))
    assert replay.sizes().tolist() == [1, 0, 2]
    assert numbers(drawn_from(replay, np.array([2, 0]), np.array([[0.9], [0.9]]))) == [[9], [8]]


def test_a_full_replay_overwrites_its_oldest_transitions() -> None:
    replay = replay_of(1, 3)
    for step in range(5):
        replay.add(np.array([0]), transition(step))
    assert replay.sizes().tolist() == [3]
    drawn = numbers(drawn_from(replay, np.array([0]), np.array([[0.1, 0.5, 0.9]])))
    assert sorted(drawn[0]) == [2, 3, 4]


@given(uniform=st.floats(0, 1, exclude_max=True), size=st.integers(1, 9))
def test_a_run_draws_only_its_own_transitions(uniform: float, size: int) -> None:
    replay = replay_of(2, 100)
    for step in range(size):
        replay.add(np.array([0]), transition(step))
    replay.add(np.array([1]), transition(50))
    assert numbers(drawn_from(replay, np.array([0]), np.array([[uniform]])))[0][0] in range(size)


@given(before=st.integers(0, 50), since=st.integers(0, 30), capacity=st.integers(5, 40))
def test_take_back_restores_the_transitions_held_at_the_mark(before: int, since: int, capacity: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(replay_module, "FIRST_ROOM", 4)
        replay = replay_of(2, capacity)
    for step in range(before):
        replay.add(np.array([0]), transition(step))
    mark = replay.mark(30)
    for step in range(since):
        replay.add(np.array([0]), transition(100 + step))
    replay.take_back(mark)
    held = int(replay.sizes()[0])
    assert held == min(before, capacity)
    seen = numbers(replay.gather(np.array([0]), np.arange(held)[None, :]))[0]
    assert sorted(seen) == list(range(max(0, before - capacity), before))


def test_a_mark_refuses_to_take_back_more_additions_than_announced() -> None:
    replay = replay_of(1, 3)
    mark = replay.mark(2)
    for step in range(3):
        replay.add(np.array([0]), transition(step))
    with pytest.raises(ValueError, match="more than 2 additions"):
        replay.take_back(mark)


@given(
    before=st.integers(0, 40),
    spoiled=st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12)), max_size=3),
    after=st.integers(0, 40),
    capacity=st.integers(5, 30),
)
def test_journals_restore_a_replay_from_which_additions_were_taken_back(
    before: int, spoiled: list[tuple[int, int]], after: int, capacity: int
) -> None:
    replay, copy = (replay_of(1, capacity) for _ in range(2))
    row = np.array([0])
    for step in range(before):
        replay.add(row, transition(step))
    marks = None
    for until_saved, since_saved in spoiled:
        mark = replay.mark(24)
        for step in range(until_saved + since_saved):
            if step == until_saved:
                copy.extend(replay.added_since(marks))
                marks = replay.marks()
            replay.add(row, transition(100 + step))
        replay.take_back(mark)
    for step in range(after):
        replay.add(row, transition(before + step))
    copy.extend(replay.added_since(marks))
    assert copy.added.tolist() == replay.added.tolist()
    held = np.arange(int(replay.sizes()[0]))[None]
    assert numbers(copy.gather(row, held)) == numbers(replay.gather(row, held))


def test_draws_are_uniform() -> None:
    replay = replay_of(1, 100)
    for step in range(8):
        replay.add(np.array([0]), transition(step))
    uniforms = np.random.default_rng(0).random((1, 80_000))
    counts = np.bincount(numbers(drawn_from(replay, np.array([0]), uniforms))[0])
    assert counts.tolist() == [pytest.approx(10_000, rel=0.05)] * 8


@given(steps=st.integers(1, 40), capacity=st.integers(5, 30))
def test_a_grown_replay_and_its_saved_copy_draw_the_same_as_a_large_one(steps: int, capacity: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(replay_module, "FIRST_ROOM", 4)
        grown = replay_of(1, capacity)
        copy = replay_of(1, capacity)
    large = replay_of(1, capacity)
    for step in range(steps):
        for replay in (grown, large):
            replay.add(np.array([0]), transition(step))
    copy.extend(grown.added_since(None))
    grid = (np.arange(50) / 50)[None]
    expected = numbers(drawn_from(large, np.array([0]), grid))
    assert set(expected[0]) == set(range(max(0, steps - capacity), steps))
    assert numbers(drawn_from(grown, np.array([0]), grid)) == expected
    assert numbers(drawn_from(copy, np.array([0]), grid)) == expected


@given(st.lists(st.integers(0, 25), min_size=1, max_size=5).filter(any), st.integers(5, 30))
def test_a_replay_extended_in_parts_equals_the_whole(parts: list[int], capacity: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(replay_module, "FIRST_ROOM", 4)
        replay, copy = (replay_of(2, capacity) for _ in range(2))
    number = 0
    for part in parts:
        marks = replay.marks()
        for _ in range(part):
            replay.add(np.array([1]), transition(number))
            number += 1
        copy.extend(replay.added_since(marks))
    grid = (np.arange(50) / 50)[None]
    assert copy.added.tolist() == [0, number]
    assert numbers(drawn_from(copy, np.array([1]), grid)) == numbers(drawn_from(replay, np.array([1]), grid))


def test_an_empty_run_draws_blank_transitions() -> None:
    replay = replay_of(2, 10)
    replay.add(np.array([1]), transition(8))
    assert drawn_from(replay, np.array([0, 1]), np.array([[0.0], [0.9]])).states[0].tolist() == [[0], [8]]


@pytest.mark.parametrize(("states", "bytes_a_number"), [(256, 2), (65_535, 2), (200_000, 4)])
def test_states_are_stored_in_as_few_bytes_as_the_number_of_states_needs(states: int, bytes_a_number: int) -> None:
    replay = replay_of(1, 10, states=states)
    replay.add(
        np.array([0]), Transitions(np.full((2, 1), states - 1), np.array([7]), np.array([1.0]), np.array([0.95]))
    )
    kept = replay.added_since(None)
    assert kept["states"].itemsize == bytes_a_number
    assert kept["states"].tolist() == [[states - 1] * 2]


@pytest.mark.parametrize(("actions", "bytes_an_action"), [(8, 1), (256, 1), (257, 2), (70_000, 4)])
def test_actions_survive_storage_in_the_fewest_bytes_that_hold_them(actions: int, bytes_an_action: int) -> None:
    replay, copy = (replay_of(1, 10, states=10, actions=actions) for _ in range(2))
    last = np.array([actions - 1])
    replay.add(np.array([0]), Transitions(np.zeros((2, 1), dtype=np.int64), last, np.ones(1), np.ones(1)))
    kept = replay.added_since(None)
    assert kept["actions"].itemsize == bytes_an_action
    copy.extend(kept)
    for each in (replay, copy):
        assert each.gather(np.array([0]), np.array([[0]])).actions.tolist() == [[actions - 1]]
