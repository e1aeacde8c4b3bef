"""Strides: from where a walker is seen to where it ends, and nothing where that isn't certain."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.stride import Going, Hold, Stride, rest
from mc_nested.live.walk import PUSH, displacement

AT_REST = Going((3.0, 5.0), (0.0, 0.0))


def _path(ticks: int, waits: int = 0, carry: float = 0.0) -> list[tuple[float, bool]]:
    """How far a walker has come after each tick, and whether the key is up by then (FACTS: Walking)."""
    place, path = 0.0, []
    for tick in range(waits + ticks + 14):
        carry = (carry if abs(carry) >= 0.003 else 0.0) + (PUSH if waits <= tick < waits + ticks else 0.0)
        place += carry
        carry *= 0.546
        path.append((place, tick >= waits + ticks))
    return path


@pytest.mark.parametrize("ticks", range(1, 8))
@pytest.mark.parametrize("felt", [-1, 0, 1])
def test_the_end_is_known_once_the_key_is_up_and_not_before(ticks: int, felt: int) -> None:
    known = []
    for place, is_up in _path(ticks + felt) if ticks + felt else []:
        going = Stride(AT_REST, Hold(1, -1, ticks, PUSH)).see((3.0, 5.0 - round(place, 3)))
        assert going is None or is_up
        if is_up:
            known.append(going is not None)
        if going is not None:
            assert going.end == pytest.approx((3.0, 5.0 - displacement(ticks + felt)), abs=0.005)
    # Two paths cross, as 3 ticks and a stop do with 4 ticks on: then it takes one tick more.
    assert known.count(False) <= 1


@given(st.integers(3, 7), st.integers(0, 3), st.floats(-0.12, 0.12), st.integers(0, 12))
def test_an_end_that_is_told_is_right_though_the_walker_was_coasting_before(
    ticks: int, waits: int, carry: float, after: int
) -> None:
    path = _path(ticks, waits, carry)
    place, _ = path[min(waits + ticks + after, len(path) - 1)]
    going = Stride(Going((0.0, 0.0), (carry, 0.0)), Hold(0, 1, ticks, PUSH)).see((place, 0.0))
    if going is not None:
        assert going.end[0] == pytest.approx(path[-1][0], abs=0.03)


@pytest.mark.parametrize("late", [4, 8, 12])
def test_a_release_that_a_stalled_game_takes_for_late_is_followed_too(late: int) -> None:
    stride = Stride(AT_REST, Hold(1, 1, 5, PUSH))
    seen = [(stride.see((3.0, 5.0 + round(place, 3))), is_up) for place, is_up in _path(5 + late)]
    assert all(going is None for going, is_up in seen if not is_up)
    ends = [going.end[1] for going, _ in seen if going]
    assert ends == pytest.approx([5.0 + displacement(5 + late)] * len(ends), abs=0.005)
    assert len(ends) > 8


@pytest.mark.parametrize("inertia", [0.4, 0.546, 0.89])
def test_on_other_ground_a_step_leaves_another_part_of_itself(inertia: float) -> None:
    place, carry, ends = 0.0, 0.0, []
    stride = Stride(AT_REST, Hold(1, 1, 5, 0.05), inertia)
    for tick in range(80):
        carry = (carry if abs(carry) >= 0.003 else 0.0) + (0.05 if tick < 5 else 0.0)
        place, carry = place + carry, carry * inertia
        if going := stride.see((3.0, 5.0 + place)):
            ends.append(going.end[1])
    assert ends == pytest.approx([5.0 + place] * len(ends), abs=0.02)
    assert len(ends) > 60


def test_a_place_on_no_path_says_nothing() -> None:
    stride = Stride(AT_REST, Hold(1, 1, 5, PUSH))
    assert stride.see((3.0, 5.5)) is None
    assert stride.see((3.1, 5.944)) is None


def test_somebody_who_has_not_set_off_may_still_do_so() -> None:
    assert Stride(AT_REST, Hold(1, 1, 5, PUSH)).see((3.0, 5.0)) is None
    assert Stride(AT_REST).see((3.0, 5.0)) == AT_REST


@pytest.mark.parametrize(("place", "ticks"), [(0.098, 1), (0.2495, 2), (0.4303, 3), (0.05, None), (0.944, None)])
def test_on_the_way_it_tells_how_many_ticks_felt_the_key(place: float, ticks: int | None) -> None:
    assert Stride(AT_REST, Hold(1, 1, 5, PUSH)).ticks_held((3.0, 5.0 + place)) == ticks


def test_without_a_hold_no_tick_felt_one() -> None:
    assert Stride(AT_REST).ticks_held((3.0, 5.0)) is None


@given(st.floats(-0.3, 0.3))
def test_a_carry_comes_to_rest_where_its_steps_end(carry: float) -> None:
    place, left = 0.0, carry
    while abs(left) >= 0.003:
        place, left = place + left, left * 0.546
    assert rest(carry) == pytest.approx(place, abs=1e-9)
