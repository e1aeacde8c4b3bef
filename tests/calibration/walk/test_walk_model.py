"""WalkModel: the fit of push, inertia and latency to synthetic holds, and holds that are refused.

The line through holds that fit no ticks: what it says, and when there is none.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import pytest

from calibration.walk.gait_fit import GaitModel
from calibration.walk.survey import SurveyHold
from calibration.walk.walk_model import SHORTEST_STEP, WalkModel, empirical_walk, fit_walk_model
from calibration.walk.walker import RecordedHold, Sighting
from mc_nested.errors import NotConfirmedError
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import INERTIA, PUSH, SNEAKING, TICK_S, Gait, displacement, walk_response
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, INPUT_LATENCY_S
from mc_nested.live.profile.tables import WalkTable

HOME = GroundVector(0.5, -0.5)
INPUT_S, CAPTURE_S = 0.0125, 0.0275
"""Latencies of the synthetic game, which ticks at whole multiples of 50 ms and is looked at every 4 ms."""

PLAIN = GaitModel(PUSH, INERTIA)
SNEAKED = GaitModel(PUSH * SNEAKING, INERTIA)


def hold_of(model: GaitModel, gait: Gait, pressed: float, held_s: float) -> SurveyHold:
    """Return a hold forward, as it is seen on the screen."""
    first = math.ceil((pressed + INPUT_S) / TICK_S)
    ticks = math.ceil((pressed + held_s + INPUT_S) / TICK_S) - first
    sightings = [
        Sighting(at - 0.002, at + 0.002, GroundVector(0.5, covered - 0.5))
        for tick, covered in enumerate(model.path(ticks)[1:])
        for at in [(first + tick) * TICK_S + CAPTURE_S]
    ]
    return SurveyHold("forward", gait, held_s / TICK_S, RecordedHold(pressed, pressed + held_s, HOME, tuple(sightings)))


def holds(walking: GaitModel = PLAIN, sneaking: GaitModel = SNEAKED, count: int = 32) -> list[SurveyHold]:
    """Return walking holds of 1 to 8 ticks and a bit, and half as many sneaking ones, at all phases of the tick."""
    walked = [hold_of(walking, "walk", 10 + 2.0309 * index, (1.1 + index % 8) * TICK_S) for index in range(count)]
    sneaked = [hold_of(sneaking, "sneak", 100 + 2.0309 * index, (5.1 + index) * TICK_S) for index in range(count // 2)]
    return [*walked, *sneaked]


@pytest.fixture(scope="module")
def plain() -> WalkModel:
    return fit_walk_model(holds())


def test_push_inertia_and_latency_are_found(plain: WalkModel) -> None:
    assert plain.walking.push == pytest.approx(PUSH, rel=0.001)
    assert plain.walking.inertia == pytest.approx(INERTIA, abs=0.001)
    assert plain.round_trip_s == pytest.approx(INPUT_S + CAPTURE_S, abs=0.003)
    assert plain.speed == pytest.approx(4.317, abs=0.01)
    assert (len(plain.good), plain.outliers, plain.late) == (48, 0, 0)
    assert max(plain.fit_rms, plain.held_out_rms) < 0.001
    assert (plain.is_plain, plain.is_lagging) == (True, False)
    # Ticks come at whole multiples of 50 ms, and their steps are seen 27.5 ms later.
    assert plain.tick_phase % TICK_S == pytest.approx(CAPTURE_S)


def test_the_profiles_table_holds_the_model(plain: WalkModel) -> None:
    assert plain.table.covered == pytest.approx(walk_response(12), abs=0.002)
    assert plain.table.sneaking == pytest.approx(SNEAKING, abs=0.001)
    assert plain.table.input_latency_s + plain.table.capture_latency_s == pytest.approx(plain.round_trip_s, abs=1e-4)
    assert plain.table.input_latency_s < plain.table.capture_latency_s


def test_a_faster_player_and_another_floor_are_not_plain(plain: WalkModel) -> None:
    assert not replace(plain, walking=GaitModel(PUSH * 1.02, INERTIA)).is_plain
    assert not replace(plain, walking=GaitModel(PUSH * 0.98, INERTIA)).is_plain
    assert replace(plain, walking=GaitModel(PUSH * 1.01, INERTIA)).is_plain
    ice = INERTIA + 0.02
    assert not replace(plain, walking=GaitModel(PUSH / (1 - INERTIA) * (1 - ice), ice)).is_plain


def test_a_game_lags_if_more_than_a_tenth_of_the_holds_is_late_or_an_outlier(plain: WalkModel) -> None:
    assert not replace(plain, late=4).is_lagging
    assert replace(plain, late=5).is_lagging
    assert replace(plain, late=2, outliers=4).is_lagging
    assert not replace(plain, late=2, outliers=2).is_lagging


def test_round_trip_is_raised_to_the_default_only_if_frames_are_slow(plain: WalkModel) -> None:
    usual = INPUT_LATENCY_S + CAPTURE_LATENCY_S
    quick = replace(plain, round_trip_s=0.011)
    for stalling in (quick, replace(quick, late=10, outliers=6), replace(quick, disagreeing=0.12)):
        assert stalling.table.input_latency_s + stalling.table.capture_latency_s == pytest.approx(0.011, abs=1e-4)
    slow = replace(quick, disagreeing=0.18).table
    assert slow.input_latency_s + slow.capture_latency_s == pytest.approx(usual, abs=1e-4)


def moved(hold: SurveyHold, *, aside: float = 0.0, later_s: float = 0.0, further: float = 0.0) -> SurveyHold:
    """Return a hold whose last positions are pushed aside or on, or seen later."""
    sightings = list(hold.recorded.sightings)
    for index in range(len(sightings) - 3, len(sightings)):
        right, forward = sightings[index].position
        since, at = sightings[index].since + later_s, sightings[index].at + later_s
        sightings[index] = Sighting(since, at, GroundVector(right + aside, forward + further))
    return replace(hold, recorded=replace(hold.recorded, sightings=tuple(sightings)))


def test_holds_pushed_aside_or_on_or_seen_late_are_counted_and_left_out() -> None:
    all_holds = holds()
    all_holds[3] = moved(all_holds[3], aside=0.06)
    all_holds[5] = moved(all_holds[5], further=0.1)
    all_holds[6] = moved(all_holds[6], later_s=0.06)
    all_holds.append(replace(all_holds[0], recorded=replace(all_holds[0].recorded, sightings=())))
    model = fit_walk_model(all_holds)
    assert (len(model.good), model.outliers, model.late) == (46, 2, 1)
    assert model.walking.push == pytest.approx(PUSH, rel=0.001)


def test_sneaking_that_is_no_slower_is_refused() -> None:
    with pytest.raises(NotConfirmedError, match="sneaking is no slower than walking"):
        fit_walk_model(holds(sneaking=GaitModel(PUSH * 0.97, INERTIA)))
    assert fit_walk_model(holds(sneaking=GaitModel(PUSH * 0.9, INERTIA))).table.sneaking == pytest.approx(0.9, abs=0.01)


def test_a_game_whose_every_hold_is_late_is_refused() -> None:
    late = [moved(hold, later_s=0.1) for hold in holds()]
    with pytest.raises(NotConfirmedError, match="every hold's ticks came late"):
        fit_walk_model(late)


USUAL = WalkTable(input_latency_s=0.02, capture_latency_s=0.04)


def hold(gait: Gait, held_s: float, covered: float) -> SurveyHold:
    sightings = (Sighting(1.0, 1.05, GroundVector(0.0, covered)),) if covered else ()
    recorded = RecordedHold(1.0, 1.0 + held_s, GroundVector(0.0, 0.0), sightings)
    return SurveyHold("forward", gait, held_s / 0.05, recorded)


def holds_led(covered_in: Callable[[float], float], count: int = 12, sneaking: float = 0.3) -> list[SurveyHold]:
    lengths = [0.03 + 0.037 * index for index in range(count)]
    walked = [hold("walk", length, covered_in(length)) for length in lengths]
    return walked + [hold("sneak", length, sneaking * covered_in(length)) for length in lengths]


def test_linear_walk_is_fitted_by_its_line() -> None:
    found = empirical_walk(holds_led(lambda held_s: 4.0 * held_s), USUAL)
    assert found is not None
    assert found.table.covered == pytest.approx([0.2 * ticks for ticks in range(1, 13)], abs=1e-4)
    assert [found.table.sneaking, found.speed] == pytest.approx([0.3, 4.0])
    assert (found.table.input_latency_s, found.table.capture_latency_s) == (0.02, 0.04)
    assert found.error == pytest.approx(0.0, abs=1e-9)


def test_a_line_that_begins_below_zero_still_grows_with_every_tick() -> None:
    found = empirical_walk(holds_led(lambda held_s: max(0.0001, 4.0 * (held_s - 0.02))), USUAL)
    assert found is not None
    assert found.table.covered[0] >= SHORTEST_STEP
    late = empirical_walk([each for each in holds_led(lambda s: 4.0 * s - 1.0, 20) if each.trace is not None], USUAL)
    assert late is not None
    assert list(late.table.covered[:3]) == pytest.approx([SHORTEST_STEP * ticks for ticks in (1, 2, 3)])


def test_holds_of_the_real_walk_are_not_fitted_by_a_line() -> None:
    assert empirical_walk(holds_led(lambda held_s: displacement(round(held_s / 0.05 + 0.01)), 20), USUAL) is None


def test_too_few_holds_or_sneaking_that_is_no_slower_give_no_line() -> None:
    assert empirical_walk(holds_led(lambda held_s: 4.0 * held_s, 7), USUAL) is None
    assert empirical_walk(holds_led(lambda held_s: 4.0 * held_s, sneaking=1.0), USUAL) is None
