"""The window's checks: in front, the display's scaling, the size and the GUI scale."""

import pytest

from calibration.doctor.snapshot import WindowSnapshot
from calibration.doctor.window_rows import front_row, scaling_row, size_row, window_row, window_rows
from mc_nested.live.model.scales import Scales
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.tables import Profile, ScreenTable

Size = tuple[int, int]


def snapshot(picture_size: Size, points: Size | None, gui_scale: int | None = 2) -> WindowSnapshot:
    scales = Scales(gui_scale, gui_scale) if gui_scale else None
    window = Fingerprint("Minecraft 1.20.1", picture_size, scales)
    return WindowSnapshot(window, picture_size, points, is_in_front=True, contents=None)


@pytest.mark.parametrize(
    ("picture_size", "points", "status", "detail"),
    [
        ((854, 480), (854, 480), "pass", "1 pixels to a point: 854 x 480 for 854 x 480"),
        ((1708, 960), (854, 480), "pass", "2 pixels to a point: 1708 x 960 for 854 x 480"),
        ((1281, 720), (854, 480), "warn", "1.5 pixels to a point: 1281 x 720 for 854 x 480"),
        ((1708, 480), (854, 480), "fail", "2 pixels to a point: 1708 x 480 for 854 x 480, but 1 downwards"),
        ((854, 480), None, "skip", "this window's points aren't known"),
    ],
)
def test_the_scaling_is_measured_on_the_picture(
    picture_size: Size, points: Size | None, status: str, detail: str
) -> None:
    row = scaling_row(snapshot(picture_size, points))
    assert (row.status, row.detail) == (status, detail)
    assert bool(row.fix) == (status in ("warn", "fail"))


@pytest.mark.parametrize(
    ("size", "scale", "status"),
    [((854, 480), 2, "warn"), ((1280, 720), 3, "warn"), ((959, 540), 2, "pass"), ((958, 540), 2, "warn")],
)
def test_below_480_gui_pixels_of_width_a_blocks_line_may_cover_the_facing_line(
    size: Size, scale: int, status: str
) -> None:
    row = size_row(snapshot(size, None, scale), None)
    assert row.status == status
    assert row.fix.startswith("" if status == "pass" else f"make the window at least {480 * scale} pixels wide")
    assert bool(row.fix) == (status == "warn")


def test_a_window_smaller_than_the_games_screens_fails() -> None:
    assert size_row(snapshot((319, 480), None), None).status == "fail"
    assert size_row(snapshot((320, 240), None, gui_scale=1), None).status == "warn"
    assert size_row(snapshot((320, 240), None, gui_scale=None), None).status == "skip"
    assert size_row(snapshot((320, 239), None), None).fix == "make the window larger than 320 x 240"


@pytest.mark.parametrize(("wanted", "status"), [(2, "pass"), (None, "pass"), (3, "fail")])
def test_a_gui_scale_is_the_profiles_if_that_names_one(wanted: int | None, status: str) -> None:
    row = size_row(snapshot((960, 540), None), Profile(screen=ScreenTable(debug_scale=wanted)))
    assert row.status == status
    assert row.detail.startswith("960 x 540 pixels, GUI scale 2")
    assert ("GUI Scale to 3" in row.fix) == (status == "fail")


@pytest.mark.parametrize(
    ("pictured", "status"),
    [
        ((1709, 961), "pass"),
        ((1709, 963), "pass"),
        ((1695, 953), "warn"),
        ((1750, 980), "warn"),
        ((1750, 960), "fail"),
        ((1700, 1000), "fail"),
    ],
)
def test_a_ratio_may_differ_from_a_whole_number_by_a_hundredth(pictured: Size, status: str) -> None:
    assert scaling_row(snapshot(pictured, (854, 480))).status == status


def test_another_window_in_front_is_a_fault() -> None:
    behind = WindowSnapshot(
        Fingerprint("Minecraft", (854, 480), None), (854, 480), None, is_in_front=False, contents=None
    )
    assert front_row(behind).status == "fail"
    assert front_row(snapshot((854, 480), None)).status == "pass"
    rows = window_rows(snapshot((854, 480), None), None)
    assert [row.name.value for row in rows] == ["game's window", "in front", "display scaling", "size and GUI scale"]


def test_a_version_later_than_all_known_ones_is_played_and_says_what_to_look_at() -> None:
    row = window_row("Minecraft 27.1 - Singleplayer")
    assert (row.status, row.detail.startswith("Minecraft 27.1 is later than 26.4")) == ("warn", True)
    assert row.fix.startswith("look in the calibration's report")
    assert window_row("Minecraft 26.4").status == "pass"
    assert window_row("A pack of mods 99").status == "pass"
