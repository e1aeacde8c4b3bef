"""Minutes of game time: those played, and those that a training should take."""

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.preset import load_preset
from mc_nested.report.game_time import expected, minutes_of

LINE = load_scenario("line")


def test_game_time_counts_actions_and_resets() -> None:
    assert minutes_of(4, 120) == pytest.approx((120 * 0.35 + 4 * 1.5) / 60)


def test_a_training_with_imagination_should_take_the_episodes_expected_without_a_prior() -> None:
    found = expected(load_preset("model-based"), LINE, stop_at_optimum=True)
    # 11 blocks in 210 cells: 211 / 12 + 1 episodes of up to 60 actions.
    assert found.episodes == 19
    assert found.minutes == pytest.approx(19 * (60 * 0.35 + 1.5) / 60)
    assert found.line(LINE) == (
        "expected: about 7 minutes of game time, 19 episodes of up to 60 actions of 0.35 s and a reset of 1.5 s"
    )


def test_a_presets_episodes_limit_the_expected_episodes() -> None:
    few = load_preset("model-based").model_copy(update={"episodes": 5})
    assert expected(few, LINE, stop_at_optimum=True).episodes == 6


def test_all_episodes_count_without_a_stop_at_the_optimum() -> None:
    live = load_preset("model-based")
    assert expected(live, LINE, stop_at_optimum=False).episodes >= live.episodes


def test_a_training_without_imagination_should_take_all_its_episodes_and_evaluations() -> None:
    paper = load_preset("paper")
    found = expected(paper, LINE, stop_at_optimum=False)
    assert found.episodes == paper.episodes + paper.episodes // paper.evaluate_every
    assert not found.is_a_limit
    spared = expected(paper, LINE, stop_at_optimum=True)
    assert spared.episodes == found.episodes
    assert spared.line(LINE).startswith("expected: at most about ")
