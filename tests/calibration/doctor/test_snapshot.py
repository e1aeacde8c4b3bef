"""Snapshots of a virtual client's window: which screen it shows, and how long its debug screen is waited for."""

import pytest

from calibration.doctor.snapshot import (
    FRONT_S,
    READABLE_S,
    UNCALIBRATED,
    WindowSnapshot,
    take_snapshot,
    wait_until_readable,
)
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.tables import GameVersion, Profile, ScreenTable
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.options import GameOptions
from sim.client.game.screens import ScreenName
from tests.calibration.contexts import started

FONT = font_of(drawn_atlas())


def shown(client: VirtualClient) -> tuple[str, str | None, int | None]:
    contents = take_snapshot(client.devices, FONT).contents
    assert contents is not None
    return contents.screen, contents.line, contents.scales and contents.scales.gui


def test_a_snapshot_of_the_world_is_read() -> None:
    snapshot = take_snapshot(started(VirtualClient()).devices, FONT)
    assert snapshot.window == Fingerprint("Minecraft 1.20.1 - Singleplayer", (854, 480), Scales(2, 2))
    assert (snapshot.picture_size, snapshot.is_in_front, snapshot.is_world) == ((854, 480), True, True)
    assert snapshot.contents is not None
    assert snapshot.contents.line == "XYZ:"
    assert snapshot.contents.reading.xyz == (0.5, 64.0, 0.5)


@pytest.mark.parametrize(("screen", "line"), [("pause", None), ("title", None), ("worlds", None), ("chat", "XYZ:")])
def test_snapshot_names_the_screen_that_is_open(screen: ScreenName, line: str | None) -> None:
    client = started(VirtualClient())
    client.game.open(screen)
    client.clock.sleep(0.3)
    assert shown(client) == (screen, line, 2)
    assert not take_snapshot(client.devices, FONT).is_world


def test_snapshot_calls_the_world_without_its_debug_screen_unknown() -> None:
    assert shown(started(VirtualClient(has_f3=False))) == ("unknown", None, None)


def test_a_debug_screen_is_found_where_the_profile_names_another_gui_scale() -> None:
    client = started(VirtualClient())
    snapshot = take_snapshot(client.devices, FONT, Profile(screen=ScreenTable(debug_scale=3)))
    assert snapshot.is_world
    assert snapshot.window.scales == Scales(2, 2)


@pytest.mark.parametrize(("screen", "name"), [("world", "world"), ("pause", "pause"), ("inventory", "menu")])
@pytest.mark.parametrize(
    ("version", "drawn"),
    [
        ("1.21.10", ScreenTable(debug_scale=2)),
        ("26.3", ScreenTable(debug_scale=1)),
        ("26.4", ScreenTable(debug_scale=1, layout="boxes")),
        ("26.3", ScreenTable()),
    ],
)
def test_under_a_modpacks_title_the_snapshot_goes_by_the_profiles_version(
    version: str, drawn: ScreenTable, screen: ScreenName, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = started(VirtualClient(version=version))
    monkeypatch.setattr(client.display, "title", lambda: "All the Mods 10")
    profile = Profile(game=GameVersion(version=version), screen=drawn)
    if screen != "world":
        client.game.open(screen)
        client.clock.sleep(0.3)
    snapshot = take_snapshot(client.devices, FONT, profile)
    assert snapshot.contents is not None
    assert snapshot.contents.screen == name
    assert snapshot.window.scales is not None
    assert snapshot.window.scales.debug == client.scales.debug
    if screen != "inventory":  # no text of the GUI's is to be read there
        assert snapshot.window.scales.gui == client.scales.gui


def test_behind_another_window_or_without_a_font_nothing_is_read() -> None:
    client = started(VirtualClient())
    assert take_snapshot(client.devices, None).contents is None
    client.set_front(is_in_front=False)
    behind = take_snapshot(client.devices, FONT)
    assert (behind.contents, behind.is_in_front, behind.window.scales) == (None, False, None)


def waited(client: VirtualClient, *, has_font: bool = True) -> tuple[WindowSnapshot, float, list[str]]:
    said: list[str] = []
    began = client.clock.now()
    snapshot = wait_until_readable(client.devices, FONT if has_font else None, UNCALIBRATED, said.append)
    return snapshot, client.clock.now() - began, said


def test_doctor_does_not_wait_if_the_screen_is_read_or_there_is_no_font() -> None:
    snapshot, seconds, said = waited(started(VirtualClient()))
    assert snapshot.is_world
    assert seconds < 0.01
    assert said == []
    _, seconds, said = waited(started(VirtualClient()), has_font=False)
    assert seconds < 0.01
    assert said == []


def test_a_person_has_half_a_minute_to_switch_to_the_game() -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    snapshot, seconds, said = waited(client)
    assert not snapshot.is_in_front
    assert FRONT_S <= seconds < FRONT_S + 0.5
    assert len(said) == 1
    assert said[0].endswith("the doctor looks for 30 s.")


def test_a_person_in_the_game_has_five_seconds_to_close_a_menu() -> None:
    client = started(VirtualClient(options=GameOptions(pause_on_lost_focus=False)))
    client.game.open("pause")
    client.clock.sleep(0.3)
    snapshot, seconds, said = waited(client)
    assert not snapshot.is_world
    assert READABLE_S <= seconds < READABLE_S + 0.5
    assert said[0].endswith("the doctor looks for 5 s.")


def test_five_seconds_to_close_a_menu_begin_once_the_game_is_in_front() -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    client.set_front(is_in_front=False)
    client.clock.call_at(client.clock.now() + 27, lambda: client.set_front(is_in_front=True))
    _, seconds, _ = waited(client)
    assert 27 + READABLE_S <= seconds < 27 + READABLE_S + 0.8
