"""The line through holds that fit no ticks: what it says, and when there is none."""

from collections.abc import Callable

import pytest

from calibration.walk.empirical import SHORTEST_STEP, empirical_walk
from calibration.walk.survey import SurveyHold
from calibration.walk.walker import RecordedHold, Sighting
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import Gait, displacement
from mc_nested.live.profile.tables import WalkTable

USUAL = WalkTable(input_latency_s=0.02, capture_latency_s=0.04)


def hold(gait: Gait, held_s: float, covered: float) -> SurveyHold:
    sightings = (Sighting(1.0, 1.05, GroundVector(0.0, covered)),) if covered else ()
    recorded = RecordedHold(1.0, 1.0 + held_s, GroundVector(0.0, 0.0), sightings)
    return SurveyHold("forward", gait, held_s / 0.05, recorded)


def holds(covered_in: Callable[[float], float], count: int = 12, sneaking: float = 0.3) -> list[SurveyHold]:
    lengths = [0.03 + 0.037 * index for index in range(count)]
    walked = [hold("walk", length, covered_in(length)) for length in lengths]
    return walked + [hold("sneak", length, sneaking * covered_in(length)) for length in lengths]


def test_a_linear_walk_gives_its_line() -> None:
    found = empirical_walk(holds(lambda held_s: 4.0 * held_s), USUAL)
    assert found is not None
    assert found.table.covered == pytest.approx([0.2 * ticks for ticks in range(1, 13)], abs=1e-4)
    assert [found.table.sneaking, found.speed] == pytest.approx([0.3, 4.0])
    assert (found.table.input_latency_s, found.table.capture_latency_s) == (0.02, 0.04)
    assert found.error == pytest.approx(0.0, abs=1e-9)


def test_a_line_that_begins_below_zero_still_grows_with_every_tick() -> None:
    found = empirical_walk(holds(lambda held_s: max(0.0001, 4.0 * (held_s - 0.02))), USUAL)
    assert found is not None
    assert found.table.covered[0] >= SHORTEST_STEP
    late = empirical_walk([each for each in holds(lambda s: 4.0 * s - 1.0, 20) if each.trace is not None], USUAL)
    assert late is not None
    assert list(late.table.covered[:3]) == pytest.approx([SHORTEST_STEP * ticks for ticks in (1, 2, 3)])


def test_minecrafts_own_holds_lie_on_no_line() -> None:
    assert empirical_walk(holds(lambda held_s: displacement(round(held_s / 0.05 + 0.01)), 20), USUAL) is None


def test_too_few_holds_or_sneaking_that_is_no_slower_give_none() -> None:
    assert empirical_walk(holds(lambda held_s: 4.0 * held_s, 7), USUAL) is None
    assert empirical_walk(holds(lambda held_s: 4.0 * held_s, sneaking=1.0), USUAL) is None
