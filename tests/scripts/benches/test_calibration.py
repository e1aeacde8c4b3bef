"""The calibration benchmark: its clients, its figures, and a few clients from nothing to two dozen actions played."""

from collections import Counter
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.model.kinematics import walk_response
from mc_nested.live.model.versions import draws_text_over_menus
from mc_nested.live.profile.tables import Profile, WalkTable
from scripts.benches.calibration import ClientResult, calibrate_and_play, click_errors, report, walk_rms
from scripts.benches.calibration_clients import NARROWEST, RANDOM_SIZES, SIZES, VERSIONS, clients, every_version
from scripts.benches.played import PlayCounts
from sim.client.client import VirtualClient
from sim.client.game.edition import Edition
from sim.client.game.f3_text import LAYOUTS
from sim.client.settings import ClientSettings, gui_scale


def test_same_seed_gives_the_same_clients_and_another_seed_gives_others() -> None:
    assert list(clients(10, 3)) == list(clients(10, 3))
    assert list(clients(10, 3)) != list(clients(10, 4))


def test_fifty_clients_cover_every_version_evenly_and_every_readable_layout() -> None:
    fifty = list(clients(50, 0))
    assert {client.version for client in fifty} == set(VERSIONS)
    counts = Counter(client.version for client in fifty)
    assert max(counts.values()) - min(counts.values()) <= 1
    assert {Edition(version).layout for version in VERSIONS} == set(LAYOUTS) - {"standin"}


def test_clients_differ_in_everything_that_a_calibration_measures() -> None:
    fifty = list(clients(50, 0))
    for what in ("size", "fps", "input_latency_s", "capture_latency_s", "feet", "yaw"):
        assert len({getattr(client, what) for client in fifty}) == 50
    assert {gui_scale(client.size, client.scale or 0) for client in fifty} == {1, 2, 3, 4}
    assert {client.swaps_sides for client in fifty} == {True, False}
    assert len({client.slipperiness for client in fifty}) > 2
    assert len({client.speed for client in fifty}) > 2


def test_windows_of_clients_are_wide_enough_for_the_debug_screens_two_columns() -> None:
    assert all(client.size[0] >= NARROWEST * gui_scale(client.size, client.scale or 0) for client in clients(200, 1))


def test_every_version_gets_all_fixed_sizes_and_random_ones_as_wide_as_the_doctor_asks() -> None:
    each = list(every_version(0))
    assert Counter(client.version for client in each) == dict.fromkeys(VERSIONS, len(SIZES) + RANDOM_SIZES)
    covered = [client for client in each if client.size not in SIZES and not draws_text_over_menus(client.version)]
    assert all(client.size[0] >= NARROWEST * gui_scale(client.size, 0) for client in covered)


def test_walk_rms_is_zero_for_the_games_own_walk_and_larger_for_a_faster_one() -> None:
    plain = Profile(walk=WalkTable(covered=walk_response(8)))
    assert walk_rms(plain, ClientSettings()) == pytest.approx(0, abs=1e-9)
    # A fifth more speed covers a fifth more: of one tick 0.210 blocks, of two 0.427.
    longer = walk_rms(Profile(walk=WalkTable(covered=walk_response(4))), ClientSettings(speed=1.2))
    assert longer == pytest.approx(0.2 * 0.587, rel=0.02)


def test_click_error_is_the_distance_from_the_buttons_middle() -> None:
    client = VirtualClient(size=(854, 480), scale=2)
    # Back to Game, from 1.19.4 on: its middle is at x = 427 / 2 + 102 - 102, y = (240 - 166) // 4 + 50 + 10 = 78.
    exact = ((213 - 102 + 102) * 2 / 854, 78 * 2 / 480)
    assert list(click_errors(Profile(points={"back_to_game": exact}), client)) == [pytest.approx(0, abs=0.51)]
    off = (exact[0], exact[1] + 6 / 480)
    assert list(click_errors(Profile(points={"back_to_game": off, "world": (0.5, 0.5)}), client)) == [
        pytest.approx(3.0)
    ]


def test_report_counts_wrong_cells_wrong_blocks_and_problems() -> None:
    good = ClientResult(
        ClientSettings(), game_s=70.0, walk_rms=0.001, click_errors=(0.5, 1.5), play=PlayCounts(actions=200)
    )
    worse = ClientResult(ClientSettings(), game_s=90.0, play=PlayCounts(actions=200, wrong_cells=1, wrong_blocks=2))
    failed = ClientResult(ClientSettings(version="26.1"), problem="walk: no", game_s=10.0)
    figures = report([good, worse, failed])
    assert (figures["clients"], figures["unattended"], figures["actions"]) == (3, 2, 400)
    assert (figures["wrong_cells"], figures["wrong_blocks"]) == (1, 2)
    assert (figures["longest_game_s"], figures["median_game_s"]) == (90.0, 70.0)
    assert (figures["walk_rms_blocks"], figures["click_off_gui_px_max"]) == (0.001, 1.5)
    assert figures["problems"] == ["26.1 (854, 480): walk: no"]


@pytest.mark.slow
def test_realistic_clients_are_calibrated_unattended_and_played_without_a_wrong_cell(
    tmp_path: Path,
) -> None:
    for number, settings in enumerate(clients(3, 11)):
        folder = tmp_path / str(number)
        folder.mkdir()
        done = calibrate_and_play(settings, folder, 25, load_scenario("diamond"))
        assert done.problem == ""
        assert done.skipped == ()
        assert done.game_s < 300
        assert done.play.actions == 25
        assert done.wrong == 0
        assert done.play.left_down == 0
        assert done.walk_rms < 0.02
        assert len(done.click_errors) == 4
        assert max(done.click_errors) <= 2
