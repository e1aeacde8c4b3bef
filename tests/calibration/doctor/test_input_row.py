"""The input's check: the debug screen's key is pressed and pressed again, and only in the world."""

import re

import pytest

from calibration.doctor.check import Check
from calibration.doctor.input_row import input_row
from calibration.doctor.snapshot import WindowSnapshot, take_snapshot
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import InputTable
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.font import drawn_atlas
from tests.calibration.contexts import started


def tried(client: VirtualClient, key: str = "f3", *, opens_menu_at: int = 99) -> Check:
    font, taken = font_of(drawn_atlas()), 0

    def snapshot() -> WindowSnapshot:
        nonlocal taken
        taken += 1
        if taken == opens_menu_at:
            client.game.open("pause")
            client.clock.sleep(0.1)
        return take_snapshot(client.devices, font)

    with InputController(client.devices, InputTable()) as controller:
        return input_row(client.devices, controller, snapshot, key)


def test_the_debug_screen_goes_off_and_comes_back() -> None:
    client = started(VirtualClient())
    row = tried(client)
    assert row.status == "pass"
    found = re.fullmatch(r"f3 pressed, and seen after (\d+) ms; pressed again, and undone", row.detail)
    assert found
    assert 10 < int(found[1]) < 500
    assert client.game.has_f3
    assert not client.window.down


def test_a_key_without_an_effect_fails_after_its_time() -> None:
    client = started(VirtualClient())
    began = client.clock.now()
    row = tried(client, "f9")
    assert row.status == "fail"
    assert row.detail == "f9 was pressed, and the debug screen stayed on"
    assert 1.5 <= client.clock.now() - began < 3


@pytest.mark.parametrize("screen", ["pause", "chat", "title"])
def test_on_another_screen_nothing_is_pressed(screen: str) -> None:
    client = started(VirtualClient())
    client.game.open(screen)  # type: ignore[arg-type]
    client.clock.sleep(0.3)
    assert tried(client).status == "skip"
    assert client.game.screen == screen


def test_behind_another_window_nothing_is_pressed() -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    row = tried(client)
    assert (row.status, row.detail) == ("skip", "another window is in front, so nothing is pressed")
    assert client.game.has_f3


def test_a_menu_that_opens_meanwhile_is_a_warning() -> None:
    client = started(VirtualClient())
    row = tried(client, opens_menu_at=2)
    assert (row.status, row.detail) == ("warn", "a menu opened meanwhile")
