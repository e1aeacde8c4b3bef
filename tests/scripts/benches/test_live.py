"""The benchmark of the live path: a short play, older pictures, and options that can't be."""

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.model.timing import FRAME_S
from scripts.bench import main
from scripts.benches.live import GROUND_PITCH, build_figures, calibrated_walk, play
from sim.client.client import VirtualClient


def test_nothing_is_wrong_in_a_short_play_without_mishaps() -> None:
    counts = play(12, 0.0, 3, load_scenario("diamond"))
    assert counts.is_right
    assert (counts.actions, counts.failed_actions, counts.mishaps) == (12, 0, 0)
    assert len(counts.moves_s) + len(counts.placings_s) == 12
    assert counts.resets >= 1
    assert min([*counts.moves_s, *counts.placings_s]) > 0
    assert sum([*counts.moves_s, *counts.placings_s]) < counts.played_s < 60


@pytest.mark.slow
def test_calibration_finds_a_capture_latency_of_75_ms_and_the_play_with_it_is_right() -> None:
    found = calibrated_walk(VirtualClient(pitch=GROUND_PITCH, capture_latency_s=(0.075, 0.075)))
    assert found.input_latency_s + found.capture_latency_s == pytest.approx(0.075 + 0.0125 + FRAME_S / 2, abs=0.012)
    usual, slow = (play(40, 0.0, 1, load_scenario("diamond"), latency_ms) for latency_ms in (None, (60.0, 90.0)))
    assert usual.is_right
    assert slow.is_right
    assert slow.corrections <= 2
    assert sum([*usual.moves_s, *usual.placings_s]) < sum([*slow.moves_s, *slow.placings_s]) < 40 * 0.32


def test_a_design_is_built_faster_where_actions_overlap() -> None:
    overlapping, waiting = (build_figures("line", 2, overlaps=overlaps) for overlaps in (True, False))
    assert overlapping["straight_s"] <= 0.245 < 0.3 < waiting["straight_s"]
    assert overlapping["median_action_s"] < waiting["median_action_s"]


@pytest.mark.parametrize("latency_ms", [("90", "60"), ("-1", "5"), ("10", "900")])
def test_latencies_out_of_range_or_out_of_order_are_refused_in_one_line(
    latency_ms: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["live", "--latency-ms", *latency_ms])
    assert "--latency-ms must be two times from 0 to 350, the shorter one first" in capsys.readouterr().err
