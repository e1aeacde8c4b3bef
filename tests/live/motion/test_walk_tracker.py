"""WalkTracker: from where a walker is seen to where it ends, and nothing if that isn't certain."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import PUSH, displacement, hold_path
from mc_nested.live.motion.walk_tracker import CoastingState, Hold, WalkTracker

AT_REST = CoastingState(GroundVector(3.0, 5.0), GroundVector(0.0, 0.0))


def _path(ticks: int, waits: int = 0, velocity: float = 0.0) -> list[tuple[float, bool]]:
    """Return how far a walker has come after each tick, and whether the key is up by then (FACTS: Walking)."""
    position, path = 0.0, []
    for tick in range(waits + ticks + 14):
        velocity = (velocity if abs(velocity) >= 0.003 else 0.0) + (PUSH if waits <= tick < waits + ticks else 0.0)
        position += velocity
        velocity *= 0.546
        path.append((position, tick >= waits + ticks))
    return path


@pytest.mark.parametrize("ticks", range(1, 8))
@pytest.mark.parametrize("felt", [-1, 0, 1])
def test_the_end_is_known_once_the_key_is_released_and_not_before(ticks: int, felt: int) -> None:
    known = []
    for position, is_released in _path(ticks + felt) if ticks + felt else []:
        state = WalkTracker(AT_REST, Hold(1, -1, ticks, PUSH)).coasting_at(GroundVector(3.0, 5.0 - round(position, 3)))
        assert state is None or is_released
        if is_released:
            known.append(state is not None)
        if state is not None:
            assert state.end == pytest.approx((3.0, 5.0 - displacement(ticks + felt)), abs=0.005)
    # Two paths cross, as 3 ticks and a stop do with 4 ticks on: then it takes one tick more.
    assert known.count(False) <= 1


@given(st.integers(3, 7), st.integers(0, 3), st.floats(-0.12, 0.12), st.integers(0, 12))
def test_a_known_end_is_right_even_if_the_walker_was_coasting_before(
    ticks: int, waits: int, velocity: float, after: int
) -> None:
    path = _path(ticks, waits, velocity)
    position, _ = path[min(waits + ticks + after, len(path) - 1)]
    state = WalkTracker(
        CoastingState(GroundVector(0.0, 0.0), GroundVector(velocity, 0.0)), Hold(0, 1, ticks, PUSH)
    ).coasting_at(GroundVector(position, 0.0))
    if state is not None:
        assert state.end[0] == pytest.approx(path[-1][0], abs=0.03)


@pytest.mark.parametrize("late", [4, 8, 12])
def test_the_tracker_follows_a_release_delayed_by_a_stall(late: int) -> None:
    tracker = WalkTracker(AT_REST, Hold(1, 1, 5, PUSH))
    seen = [
        (tracker.coasting_at(GroundVector(3.0, 5.0 + round(position, 3))), is_released)
        for position, is_released in _path(5 + late)
    ]
    assert all(state is None for state, is_released in seen if not is_released)
    ends = [state.end[1] for state, _ in seen if state]
    assert ends == pytest.approx([5.0 + displacement(5 + late)] * len(ends), abs=0.005)
    assert len(ends) > 8


@pytest.mark.parametrize("inertia", [0.4, 0.546, 0.89])
def test_the_end_is_known_on_ground_of_any_inertia(inertia: float) -> None:
    position, velocity, ends = 0.0, 0.0, []
    tracker = WalkTracker(AT_REST, Hold(1, 1, 5, 0.05), inertia)
    for tick in range(80):
        velocity = (velocity if abs(velocity) >= 0.003 else 0.0) + (0.05 if tick < 5 else 0.0)
        position, velocity = position + velocity, velocity * inertia
        if state := tracker.coasting_at(GroundVector(3.0, 5.0 + position)):
            ends.append(state.end[1])
    assert ends == pytest.approx([5.0 + position] * len(ends), abs=0.02)
    assert len(ends) > 60


@pytest.mark.parametrize(("inertia", "is_known"), [(0.546, False), (0.728, True)])
def test_a_position_slightly_off_its_path_is_accepted_only_on_slippery_ground(inertia: float, is_known: bool) -> None:
    tracker = WalkTracker(AT_REST, Hold(1, 1, 5, PUSH), inertia)
    end = hold_path(5, PUSH, inertia)[-3]
    assert tracker.coasting_at(GroundVector(3.0, 5.0 + end)) is not None
    assert (tracker.coasting_at(GroundVector(3.0, 5.0 + displacement(5, inertia) + 0.003)) is not None) == is_known


def test_a_little_more_coasting_along_the_other_axis_is_taken_for_the_end() -> None:
    begin = CoastingState(GroundVector(3.0, 5.0), GroundVector(0.0, 0.0029))
    tracker = WalkTracker(begin, Hold(0, 1, 5, PUSH))
    state = tracker.coasting_at(GroundVector(3.0 + displacement(5), 5.014))
    assert state is not None
    assert state.end == pytest.approx((3.0 + displacement(5), 5.014), abs=0.002)
    assert tracker.coasting_at(GroundVector(3.0 + displacement(5), 5.03)) is None


def test_a_position_on_no_path_gives_no_state() -> None:
    tracker = WalkTracker(AT_REST, Hold(1, 1, 5, PUSH))
    assert tracker.coasting_at(GroundVector(3.0, 5.5)) is None
    assert tracker.coasting_at(GroundVector(3.1, 5.944)) is None


def test_a_walker_that_has_not_moved_has_no_end_until_the_hold_is_over() -> None:
    assert WalkTracker(AT_REST, Hold(1, 1, 5, PUSH)).coasting_at(GroundVector(3.0, 5.0)) is None
    assert WalkTracker(AT_REST).coasting_at(GroundVector(3.0, 5.0)) == AT_REST


@pytest.mark.parametrize(("position", "ticks"), [(0.098, 1), (0.2495, 2), (0.4303, 3), (0.05, None), (0.944, None)])
def test_the_position_during_a_hold_tells_how_many_ticks_felt_the_key(position: float, ticks: int | None) -> None:
    assert WalkTracker(AT_REST, Hold(1, 1, 5, PUSH)).ticks_held(GroundVector(3.0, 5.0 + position)) == ticks


def test_ticks_held_is_none_without_a_hold() -> None:
    assert WalkTracker(AT_REST).ticks_held(GroundVector(3.0, 5.0)) is None
