"""Plans of overlapping walks: where they end, when they click, and what is never planned."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import front_of
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import INERTIA, PUSH
from mc_nested.live.motion.overlap_plan import KeyChange, Leg, Planner, Surroundings, Walk, WalkPlan
from mc_nested.live.motion.walk_tracker import AT_REST, CoastingState
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import STANDING, Player, Realm, Stack
from sim.client.game.world import AIR, VirtualWorld

SIZE, MIDDLE = 15, (7, 7)
offsets = st.floats(-0.1, 0.1)
legs = {
    "B": ((7, 6), 1, -1),
    "F": ((7, 8), 1, 1),
    "L": ((6, 7), 0, -1),
    "R": ((8, 7), 0, 1),
}


def leg(name: str) -> Leg:
    cell, axis, sign = legs[name[0]]
    return Leg(cell, axis, sign, name.endswith("D"))


def after(one: Leg, name: str) -> Leg:
    """Return the leg of that name from where another one ends."""
    next_one = leg(name)
    right, forward = (there - from_ for there, from_ in zip(next_one.cell, MIDDLE, strict=True))
    return next_one._replace(cell=(one.cell[0] + right, one.cell[1] + forward))


def planner(*solid: Cell, lag: int = 1) -> Planner:
    return Planner(Surroundings.seen_at(65.0, SIZE, set(solid)), PUSH, lag, 0.15)


def standing(right: float = 0.0, forward: float = 0.0) -> Walk:
    return Walk(0, CoastingState(GroundVector(7 + right, 7 + forward), AT_REST))


def planned(
    one: str, other: str | None, walk: Walk | None = None, *solid: Cell, no_forward: int = 0
) -> WalkPlan | None:
    first = leg(one)
    following = after(first, other) if other else None
    return planner(*solid).plan(walk or standing(), first, 2, 2, following, no_forward)


def test_a_walk_is_the_recurrence_of_the_facts() -> None:
    walk = standing().also(KeyChange(0, GroundVector(0.0, PUSH)), KeyChange(2, AT_REST))

    one, two = PUSH, PUSH + PUSH * INERTIA
    positions = walk.positions(4)

    assert positions[1].forward == pytest.approx(7 + one)
    assert positions[2].forward == pytest.approx(7 + one + two)
    assert positions[3].forward == pytest.approx(7 + one + two + two * INERTIA)
    assert walk.end(2).forward == pytest.approx(7 + 0.427, abs=0.001)


def test_one_cell_from_rest_is_five_ticks() -> None:
    plan = planned("B", None)
    assert plan is not None
    assert (plan.release, plan.start, plan.stop) == (7, None, 7)


def test_the_same_direction_goes_on_without_letting_go() -> None:
    plan = planned("BD", "BD")
    assert plan is not None
    assert plan.start is None
    assert plan.stop - plan.release in (4, 5)
    assert [change.push for change in plan.changes] == [GroundVector(0.0, -PUSH), AT_REST]


def test_another_direction_begins_as_the_key_goes_up() -> None:
    plan = planned("B", "L")
    assert plan is not None
    assert (plan.release, plan.start) == (7, 7)


def test_a_block_is_waited_for_before_its_column_is_left() -> None:
    """L+D, then R+D: the floor is seen a tick after the eyes see it, the click comes then, and the block is seen."""
    plan = planned("LD", "RD")
    assert plan is not None
    positions = Walk(0, standing().state, plan.changes).positions(plan.stop)
    assert plan.click is not None
    assert all(abs(positions[tick].right - 6) <= 0.48 for tick in (plan.click, plan.click + 1))


def test_nothing_is_planned_through_a_block() -> None:
    assert planned("L", "B", None, (6, 7)) is None
    assert planned("L", "B", None, (6, 6)) is None


def test_forward_is_not_pressed_before_it_may_be() -> None:
    plan = planned("B", "F", no_forward=10)
    assert plan is not None
    assert plan.start == 10


def test_forward_does_not_go_on_where_it_would_have_to_be_pressed_again() -> None:
    """From three cells off the far edge, what stands where a late click lands isn't known: forward would stop first."""
    far = Leg((7, 13), 1, 1, True)
    walk = Walk(0, CoastingState(GroundVector(7.0, 12.0), AT_REST))
    assert planner().plan(walk, far, 2, 2, Leg((7, 14), 1, 1, False), 0) is None


def test_no_click_is_sent_near_an_edge_while_the_key_is_down() -> None:
    """A game that stalls may carry the agent two cells on: the click comes once the key was seen to be up."""
    near_edge = Walk(0, CoastingState(GroundVector(7.0, 2.0), AT_REST))
    plan = planner().plan(near_edge, Leg((7, 1), 1, -1, True), 2, 2, None, 0)
    assert plan is not None
    assert plan.click is not None
    assert plan.click >= plan.release + 2


@given(
    st.sampled_from(["BD", "LD", "RD", "FD", "B", "L", "R", "F"]),
    st.sampled_from(["BD", "LD", "RD", "B", "L", "R", None]),
    offsets,
    offsets,
    st.integers(1, 3),
)
def test_a_plan_ends_near_the_middle_and_its_click_is_right_early_and_late(
    one: str, other: str | None, right: float, forward: float, lag: int
) -> None:
    first = leg(one)
    following = after(first, other) if other else None
    walk = standing(right, forward)
    plan = planner(lag=lag).plan(walk, first, 2, 2, following, 0)
    assume(plan is not None)
    assert plan is not None

    last = following or first
    whole = Walk(0, walk.state, plan.changes)
    end = whole.end(plan.stop)
    assert abs(end[last.axis] - last.cell[last.axis]) <= 0.11
    if plan.click is not None:
        for felt in range(plan.click - 1, plan.click + 3):
            around = Surroundings.seen_at(65.0, SIZE, ())
            assert around.landing(whole.positions(plan.stop + 9)[felt]) in (front_of(first.cell), None)


@given(
    st.sampled_from(["BD", "LD", "RD", "FD", "B", "L", "R"]), st.sampled_from(["B", "BD", "L", "R"]), offsets, offsets
)
def test_there_is_a_plan_from_everywhere_that_an_action_ends(
    one: str, other: str, right: float, forward: float
) -> None:
    assert planned(one, other, standing(right, forward)) is not None


@given(st.floats(6.4, 7.6), st.floats(6.4, 7.6), st.sets(st.sampled_from([(7, 8), (6, 8), (8, 8), (7, 9), (6, 7)])))
def test_a_click_lands_where_the_game_places_it(right: float, forward: float, solid: set[Cell]) -> None:
    """An agent that faces south has west to its right: cell (x, y) is block (-x, 64, y)."""
    around = Surroundings.seen_at(65.0, SIZE, solid)
    position = GroundVector(right, forward)
    assume(around.is_free(position))
    assume(all(abs(each + 0.5 - round(each + 0.5)) > 1e-3 for each in (right, forward + around.ahead)))
    world = VirtualWorld(64, "bedrock")
    for x, y in solid:
        world.put((-x, 64, y), "stone")
    player = Player((-right + 0.5, 64.0, forward + 0.5), 0.0, 65.0)
    player.hotbar[0] = Stack("dirt", 64)
    game = VirtualGame(Realm(Edition("1.20.1"), world, player))
    before = dict(world.built())

    game.keys.press("right button")
    game.tick()

    placed = {(-x, y) for (x, level, y), name in world.built().items() - before.items() if name != AIR and level == 64}
    landing = around.landing(position)
    assert placed == ({landing} if landing else set())
    assert math.isclose(STANDING[1], 1.62)
