"""The facts that a recording states of itself: the window and the monitors, as far as they are known."""

import dataclasses
from pathlib import Path

import pytest

from mc_nested.live.devices import DesktopArea
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.recording_file import facts_of
from mc_nested.live.recording.run_recorder import open_recorder
from sim.client.client import VirtualClient

LAPTOP, DESK = DesktopArea(0, 0, 1280, 720), DesktopArea(-1920, -180, 1920, 1080)


@pytest.mark.parametrize(
    ("area", "listed", "window", "monitors"),
    [
        (DesktopArea(100, 50, 427, 240), (LAPTOP,), "427x240 at 100 50", "1280x720 at 0 0"),
        (
            DesktopArea(-1900, -100, 854, 480),
            (LAPTOP, DESK),
            "854x480 at -1900 -100",
            "1280x720 at 0 0, 1920x1080 at -1920 -180",
        ),
        (DesktopArea(0, 0, 854, 480), (), "854x480 at 0 0", "unknown"),
        (None, None, "unknown", "unknown"),
    ],
    ids=["one monitor, two pixels to a point", "two monitors", "a desktop that names none", "no desktop"],
)
def test_a_recording_names_the_window_and_the_monitors(
    area: DesktopArea | None, listed: tuple[DesktopArea, ...] | None, window: str, monitors: str, tmp_path: Path
) -> None:
    client = VirtualClient(seed=1)
    devices = dataclasses.replace(
        client.devices,
        area=None if area is None else lambda: area,
        monitors=None if listed is None else lambda: listed,
    )
    with open_recorder(tmp_path / "one", "play-line", print, Profile(), devices, {}) as recording:
        assert recording
        recording.devices(devices).clock.now()
    facts = facts_of(tmp_path / "one")
    assert (facts["size"], facts["title"]) == ("854x480", client.display.title())
    assert (facts["window"], facts["monitors"]) == (window, monitors)
