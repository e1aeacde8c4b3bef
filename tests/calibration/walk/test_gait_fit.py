"""A gait's model is fitted to holds: known paths, other floors and speeds, and outliers that are left out."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.walk.gait_fit import FEWEST, GaitModel, HoldTrace, fit_gait, match_hold, rms
from mc_nested.errors import NotConfirmedError
from mc_nested.live.model.kinematics import INERTIA, PUSH, SNEAKING, TICK_S, displacement
from scripts.benches.walked import displacement as walked
from sim.client.game import physics

PLAIN = GaitModel(PUSH, INERTIA)


def trace_of(model: GaitModel, held_s: float, felt: int, *, seen_of: np.random.Generator | None = None) -> HoldTrace:
    """Return a hold as the debug screen shows it, in three decimals; ``seen_of`` leaves some positions out."""
    path = [round(position, 3) for position in model.path(felt)[1:]]
    kept = [position for position in path[:-1] if seen_of is None or seen_of.random() < 0.8]
    return HoldTrace("walk", held_s, tuple(dict.fromkeys([*kept, path[-1]])))


def holds(model: GaitModel, seed: int, count: int = 24) -> list[HoldTrace]:
    """Return holds of 1 to 8 ticks, a few of them felt a tick longer or shorter than they were."""
    rng = np.random.default_rng(seed)
    asked = [1 + index % 8 + rng.uniform(-0.4, 0.4) for index in range(count)]
    return [
        trace_of(model, ticks * TICK_S, max(1, round(ticks) + int(rng.choice([-1, 0, 0, 1]))), seen_of=rng)
        for ticks in asked
    ]


def test_path_of_a_plain_hold_has_the_distances_of_facts_md() -> None:
    assert [round(PLAIN.covered(held), 3) for held in range(7)] == [0, 0.210, 0.427, 0.642, 0.857, 1.073, 1.291]
    # The first steps of a hold of two ticks: a push, 1.546 pushes, and then 0.546 of the step before.
    first = PLAIN.path(2)[:4]
    assert first == pytest.approx((0, PUSH, 2.546 * PUSH, 2.546 * PUSH + 0.546 * 1.546 * PUSH))


@given(st.integers(1, 30))
def test_path_ends_at_the_displacement_that_the_live_path_expects(held: int) -> None:
    assert PLAIN.covered(held) == pytest.approx(displacement(held))
    ice = physics.Ground(slipperiness=0.98, speed=1.4)
    model = GaitModel(physics.INPUT * ice.acceleration, ice.inertia)
    assert model.covered(held) == pytest.approx(walked(held, "walk", ice))


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(("slipperiness", "speed"), [(0.6, 1.0), (0.6, 0.7), (0.6, 1.4), (0.8, 1.2), (0.98, 1.0)])
def test_fit_finds_the_gait_model_of_other_floors_and_speeds(slipperiness: float, speed: float, seed: int) -> None:
    ground = physics.Ground(slipperiness, speed)
    model = fit_gait(holds(GaitModel(physics.INPUT * ground.acceleration, ground.inertia), seed))
    assert model.inertia == pytest.approx(ground.inertia, abs=0.003)
    for held in range(1, 13):
        assert model.covered(held) == pytest.approx(walked(held, "walk", ground), abs=0.005)


def test_with_a_known_inertia_few_long_holds_give_the_push() -> None:
    sneaking = GaitModel(SNEAKING * PUSH, INERTIA)
    traces = [trace_of(sneaking, asked * TICK_S, asked + more) for asked in (5, 31) for more in (-1, 0, 1, 0)]
    assert fit_gait(traces, INERTIA).push == pytest.approx(SNEAKING * PUSH, rel=0.002)


@given(st.integers(1, 12), st.sampled_from([-2, -1, 0, 1, 2]))
def test_hold_is_matched_to_the_ticks_that_it_lasted_and_not_to_those_asked_for(asked: int, more: int) -> None:
    felt = max(1, asked + more)
    match = match_hold(trace_of(PLAIN, asked * TICK_S, felt), PLAIN)
    assert match.ticks == felt
    assert not match.is_outlier
    assert abs(match.end_error) < 0.001
    assert match.at_tick == tuple(range(1, len(match.at_tick) + 1))


def test_holds_that_were_cut_short_or_pushed_are_left_out() -> None:
    good = holds(PLAIN, 7)
    cut = HoldTrace("walk", 0.2, (0.098, 0.25, 0.5))
    pushed = HoldTrace("walk", 0.2, (0.098, 0.4, 0.9, 1.31))
    model = fit_gait([*good, cut, pushed])
    assert model.push == pytest.approx(PUSH, abs=0.0005)
    assert [match_hold(trace, model).is_outlier for trace in (cut, pushed, good[0])] == [True, True, False]


def test_too_few_holds_give_no_model() -> None:
    with pytest.raises(NotConfirmedError, match=f"only {FEWEST - 1} holds"):
        fit_gait(holds(PLAIN, 1, FEWEST - 1))
    stopped = [HoldTrace("walk", 0.3, (0.05 + 0.001 * index, 0.4 + 0.07 * index)) for index in range(FEWEST)]
    with pytest.raises(NotConfirmedError, match="could be followed"):
        fit_gait(stopped)


def test_rms_of_an_empty_list_is_zero() -> None:
    assert rms([]) == 0
    assert rms([3, -4]) == pytest.approx(12.5**0.5)
