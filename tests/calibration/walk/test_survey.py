"""Survey holds: each hold's direction, sideways drift and timing, and the keys that follow from them.

Which key goes which way, from where a step with each of them ended.
"""

import itertools
from typing import cast

import pytest

from calibration.walk.survey import (
    DIRECTIONS,
    SHORTEST,
    Direction,
    Survey,
    SurveyHold,
    corrected_keys,
    describe_keys,
    direction_of,
)
from calibration.walk.walker import RecordedHold, Sighting, Walker
from mc_nested.errors import UserError
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.profile.tables import KeysTable
from tests.live.fake_game import FakeClock

BEGIN = GroundVector(0.5, -0.25)


def recorded(*offsets: tuple[float, float]) -> RecordedHold:
    """Return a hold of 0.2 seconds with these positions, right and forward of where it began, seen 50 ms apart."""
    sightings = [
        Sighting(1.05 + 0.05 * index, 1.058 + 0.05 * index, GroundVector(0.5 + right, -0.25 + forward))
        for index, (right, forward) in enumerate(offsets)
    ]
    return RecordedHold(1.0, 1.2, BEGIN, tuple(sightings))


@pytest.mark.parametrize(
    ("direction", "right", "forward"), [("forward", 0, 1), ("back", 0, -1), ("right", 1, 0), ("left", -1, 0)]
)
def test_a_trace_runs_along_the_holds_direction(direction: Direction, right: int, forward: int) -> None:
    hold = SurveyHold(direction, "walk", 4, recorded((0.1 * right, 0.1 * forward), (0.3 * right, 0.3 * forward)))
    trace = hold.trace
    assert trace is not None
    assert trace.gait == "walk"
    assert trace.held_s == pytest.approx(0.2)
    assert trace.covered == pytest.approx((0.1, 0.3))
    assert hold.aside == pytest.approx(0.0)


def test_positions_that_go_back_are_left_out_of_a_trace() -> None:
    trace = SurveyHold("forward", "sneak", 4, recorded((0, 0.1), (0, 0.05), (0, 0.1), (0, 0.2))).trace
    assert trace is not None
    assert trace.covered == pytest.approx((0.1, 0.2))


def test_a_hold_that_moved_nothing_or_the_other_way_has_no_trace() -> None:
    assert SurveyHold("forward", "walk", 4, recorded()).trace is None
    assert SurveyHold("forward", "walk", 4, recorded((0.0, -0.1))).trace is None


def test_hold_reports_its_largest_sideways_distance() -> None:
    assert SurveyHold("forward", "walk", 4, recorded((0.0, 0.1), (-0.07, 0.2), (0.02, 0.3))).aside == pytest.approx(
        0.07
    )
    assert SurveyHold("right", "walk", 4, recorded((0.1, 0.04))).aside == pytest.approx(0.04)
    assert SurveyHold("right", "walk", 4, recorded()).aside == 0.0


def test_the_timing_pairs_each_position_with_its_tick_and_leaves_out_the_beginning() -> None:
    hold = SurveyHold("forward", "walk", 4, recorded((0.0, 0.0), (0.0, 0.1), (0.0, 0.3)))
    timing = hold.timing((0, 1, 2), 2)
    assert (timing.pressed, timing.released, timing.ticks) == (1.0, 1.2, 2)
    assert [step[0] for step in timing.steps] == [1, 2]
    assert [step[1:] for step in timing.steps] == [pytest.approx((1.1, 1.108)), pytest.approx((1.15, 1.158))]


class FlatWalker:
    """Every hold covers a tenth of a block a tick, right and forward, and brings the player back to where it began."""

    def __init__(self) -> None:
        self.held_ticks: list[int] = []

    def stand(self) -> GroundVector:
        return BEGIN

    def position(self) -> GroundVector:
        return BEGIN

    def hold(self, seconds: float, _key: str, *, sneak: str | None, phase: float, max_distance: float) -> RecordedHold:
        assert (sneak, phase >= 0, max_distance) == (None, True, float("inf"))
        ticks = seconds / 0.05
        self.held_ticks.append(round(ticks))
        end = GroundVector(BEGIN.right + 0.1 * ticks, BEGIN.forward + 0.1 * ticks)
        return RecordedHold(1.0, 1.0 + seconds, BEGIN, (Sighting(1.0, 1.05, end),))


@pytest.mark.parametrize(("reach", "longest"), [(0.0, SHORTEST), (0.75, max(SHORTEST, 7))])
def test_every_short_hold_is_made_and_longer_ones_as_far_as_the_floor_is_free(reach: float, longest: int) -> None:
    walker = FlatWalker()
    survey = Survey(cast("Walker", walker), KeysTable(), FakeClock())
    survey.reach = reach
    survey.walk()
    assert set(walker.held_ticks) == set(range(1, longest + 1))


KEYS = KeysTable()


@pytest.mark.parametrize(
    ("offset", "way"),
    [
        ((0.0, 0.32), "forward"),
        ((0.02, -0.32), "back"),
        ((0.32, 0.05), "right"),
        ((-0.32, 0.0), "left"),
        ((0.2, 0.2), None),
        ((0.0, 0.05), None),
        ((0.0, 0.0), None),
    ],
)
def test_a_step_leads_in_one_direction_or_in_none(offset: tuple[float, float], way: Direction | None) -> None:
    assert direction_of(offset) == way


def test_corrected_keys_assign_each_key_to_the_direction_that_it_moves() -> None:
    for led in itertools.permutations(DIRECTIONS):
        keys = corrected_keys(KEYS, dict(zip(DIRECTIONS, led, strict=True)))
        for way, found in zip(DIRECTIONS, led, strict=True):
            assert getattr(keys, found) == getattr(KEYS, way)


def test_description_of_the_keys_says_that_left_and_right_were_swapped() -> None:
    keys = corrected_keys(KEYS, {"forward": "forward", "back": "back", "left": "right", "right": "left"})
    assert (keys.left, keys.right, keys.forward, keys.sneak) == ("d", "a", "w", "left.shift")
    assert describe_keys(KEYS, keys).endswith("the profile had left and right the other way round")
    assert describe_keys(KEYS, KEYS) == "w goes forward, s goes back, a goes left, d goes right"


def test_key_without_an_effect_or_two_keys_of_one_direction_are_an_error() -> None:
    with pytest.raises(UserError, match="the key a doesn't move the player left"):
        corrected_keys(KEYS, {"forward": "forward", "back": "back", "left": None, "right": "right"})
    with pytest.raises(UserError, match="don't go four ways"):
        corrected_keys(KEYS, {"forward": "forward", "back": "forward", "left": "left", "right": "right"})
