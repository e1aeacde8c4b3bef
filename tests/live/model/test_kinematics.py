"""The recurrence of walking against the facts' table, and which hold is planned for a distance."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.kinematics import (
    PUSH,
    HoldPlan,
    coasted,
    displacement,
    hold_path,
    hold_paths,
    nearest_ticks,
    plan_hold,
    push_of,
    ticked,
    walk_response,
)


@pytest.mark.parametrize(("ticks", "blocks"), [(1, 0.210), (2, 0.427), (3, 0.642), (4, 0.857), (5, 1.073), (6, 1.291)])
def test_holds_cover_the_distances_in_the_facts(ticks: int, blocks: float) -> None:
    assert displacement(ticks) == pytest.approx(blocks, abs=0.0006)


def test_a_hold_of_zero_ticks_covers_no_distance() -> None:
    assert displacement(0) == 0.0


def test_a_long_walk_ends_at_the_steady_speed() -> None:
    assert (displacement(101) - displacement(100)) * 20 == pytest.approx(4.317, abs=0.001)


def test_one_block_takes_five_ticks() -> None:
    assert nearest_ticks(1.0, walk_response(12)) == 5


def test_zero_ticks_are_nearest_for_a_tiny_distance() -> None:
    assert nearest_ticks(0.1, walk_response(12)) == 0


@given(st.floats(0.0, 2.58))
def test_the_nearest_hold_ends_within_half_a_tick_of_walking(distance: float) -> None:
    response = walk_response(12)
    ends = (0.0, *response)
    assert abs(ends[nearest_ticks(distance, response)] - distance) <= 0.1093


def test_the_push_follows_from_the_longest_hold() -> None:
    assert push_of(walk_response(12)) == pytest.approx(PUSH)
    assert push_of([0.2, 2 * displacement(2)]) == pytest.approx(2 * PUSH)
    assert push_of([displacement(1, 0.9)], 0.9) == pytest.approx(PUSH)


@pytest.mark.parametrize(
    ("distance", "tolerance", "plan"),
    [
        (1.0, 0.1, HoldPlan("walk", 5)),
        (0.32, 0.15, HoldPlan("walk", 2)),
        # Walking ends at 0.210 or 0.427; five ticks of sneaking end at 0.3 * 1.073 = 0.322.
        (0.32, 0.05, HoldPlan("sneak", 5)),
        (0.0, 0.05, HoldPlan("sneak", 1)),
        (0.2, 0.005, HoldPlan("sneak", 3)),
        (9.0, 0.05, HoldPlan("walk", 12)),
    ],
)
def test_sneaking_is_planned_only_if_walking_misses_and_sneaking_ends_nearer(
    distance: float, tolerance: float, plan: HoldPlan
) -> None:
    assert plan_hold(distance, walk_response(12), tolerance) == plan


def test_plan_hold_sneaks_as_near_as_possible_when_it_must_sneak() -> None:
    assert plan_hold(0.21, walk_response(12), 0.15) == HoldPlan("walk", 1)
    assert plan_hold(0.21, walk_response(12), 0.15, must_sneak=True) == HoldPlan("sneak", 3)
    assert plan_hold(0.01, walk_response(12), 0.15, must_sneak=True) == HoldPlan("sneak", 1)


def test_a_tie_between_walking_and_sneaking_is_walked() -> None:
    # Walking ends at 1.0, sneaking at 0.5: both are 0.25 off.
    assert plan_hold(0.75, [1.0], 0.1, 0.5) == HoldPlan("walk", 1)
    assert plan_hold(0.74, [1.0], 0.1, 0.5) == HoldPlan("sneak", 1)


@pytest.mark.parametrize(
    ("velocity", "push", "step"),
    [
        (0.1, 0.05, 0.15),
        (0.1, 0.0, 0.1),
        (0.0029, 0.0, 0.0),
        (0.003, 0.0, 0.003),
        (-0.0029, 0.05, 0.05),
        (-0.1, 0.0, -0.1),
    ],
)
def test_a_step_adds_push_and_velocity_and_a_velocity_below_0_003_counts_as_0(
    velocity: float, push: float, step: float
) -> None:
    assert ticked(2.0, velocity, push, 0.5) == pytest.approx((2.0 + step, step / 2))


def test_a_path_holds_each_ticks_position_until_standstill() -> None:
    # Steps of a hold of two ticks with push 0.1 and inertia 0.1: 0.1, 0.11, 0.011; then 0.0011 is a standstill.
    assert hold_path(2, 0.1, 0.1) == pytest.approx((0.0, 0.1, 0.21, 0.221))
    assert hold_path(0) == (0.0,)


def test_hold_paths_agrees_with_hold_path_for_each_hold() -> None:
    assert hold_paths(12, 0.1, 0.7) == [hold_path(ticks, 0.1, 0.7) for ticks in range(13)]


def test_the_distance_of_a_hold_depends_on_the_grounds_inertia() -> None:
    # A step of 0.098 with inertia 0.1 leaves 0.0098, then 0.00098 is a standstill.
    assert displacement(1, 0.1) == pytest.approx(PUSH * 1.1)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_walker_coasts_until_its_velocity_is_below_0_003(sign: int) -> None:
    states = [(2.0, sign * 0.02), (2.0 + sign * 0.02, sign * 0.01), (2.0 + sign * 0.03, sign * 0.005)]
    states.append((2.0 + sign * 0.035, sign * 0.0025))
    assert coasted(2.0, sign * 0.02, 0.5) == [pytest.approx(state) for state in states]
