"""The checks of the debug screen and of the window, for each content of the window.

Pictures in which nothing can be read: black ones, and ones of other colours.

The window's checks: in front, the display's scaling, the size and the GUI scale.
"""

from pathlib import Path

import numpy as np
import pytest

from calibration.doctor.check import Check, CheckName
from calibration.doctor.screen_rows import (
    BLACK,
    BRIGHT,
    FAINT,
    SCREEN_CHECKS,
    front_row,
    picture_fault,
    reduced_by_options,
    scaling_row,
    screen_rows,
    size_row,
    window_row,
    window_rows,
)
from calibration.doctor.snapshot import ScreenContents, WindowSnapshot
from calibration.installation.options_txt import parse_options
from mc_nested.live.devices import Frame
from mc_nested.live.menus.screens import ScreenName
from mc_nested.live.model.debug_entries import switch_on
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.tables import Profile, ScreenTable
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from tests.calibration.contexts import started

READ = Reading(xyz=(0.5, 64.0, 0.25), yaw=0.0, pitch=40.0, target=Target((0, 63, 1), "minecraft:stone"))


def snapshot(
    reading: Reading, screen: ScreenName = "world", line: str | None = "XYZ:", version: str = "1.20.1"
) -> WindowSnapshot:
    contents = ScreenContents(screen, line, Scales(2, 2), reading)
    return WindowSnapshot(
        Fingerprint(f"Minecraft {version}", (854, 480), Scales(2, 2)), (854, 480), None, True, contents
    )


def rows(of: WindowSnapshot) -> dict[str, tuple[str, str, str]]:
    return {row.name.value: (row.status, row.detail, row.fix) for row in screen_rows(of, None)}


def test_a_debug_screen_that_is_read_passes() -> None:
    assert rows(snapshot(READ)) == {
        "debug screen": ("pass", "on, at GUI scale 2", ""),
        "reduced debug info": ("pass", "off", ""),
        "position line": ("pass", "XYZ: 0.500 / 64.000 / 0.250", ""),
        "looked-at line": ("pass", "minecraft:stone at 0 63 1", ""),
    }


@pytest.mark.parametrize(("is_in_front", "reason"), [(True, "no font to read it with"), (False, "another window")])
def test_screen_rows_are_skipped_without_a_font_or_behind_another_window(is_in_front: bool, reason: str) -> None:
    unseen = WindowSnapshot(Fingerprint("Minecraft", (854, 480), None), (854, 480), None, is_in_front, None)
    checks = screen_rows(unseen, None)
    assert [check.name for check in checks] == list(SCREEN_CHECKS)
    assert all(check.status == "skip" and check.detail.startswith(reason) for check in checks)


def test_debug_screen_row_names_the_screen_that_is_shown_instead() -> None:
    pause = rows(snapshot(Reading(problem="no XYZ line: press F3"), "pause", None))
    assert pause["debug screen"] == ("fail", "the Game Menu is open", "click Back to Game")
    assert {status for status, _, _ in list(pause.values())[1:]} == {"skip"}
    unknown = rows(snapshot(Reading(problem="no XYZ line: press F3"), "unknown", None))
    assert unknown["debug screen"] == ("fail", "no XYZ line", "press F3")


def test_fix_for_an_open_chat_is_to_press_esc() -> None:
    assert rows(snapshot(READ, "chat"))["debug screen"] == ("fail", "the chat is open", "press Esc")


def test_reading_problem_fails_the_debug_screen_row_only_if_its_position_line_was_found() -> None:
    broken = Reading(problem="XYZ: half a line: widen the window")
    seen = rows(snapshot(broken, "unknown"))
    assert seen["debug screen"] == ("fail", "XYZ: half a line", "widen the window")
    assert seen["position line"][:2] == ("pass", "XYZ is there, but see the debug screen's row")
    part = rows(snapshot(broken, "unknown", "Facing:"))
    assert part["debug screen"][0] == "pass"
    assert part["reduced debug info"][0] == "skip"
    assert part["position line"] == ("fail", "XYZ", "half a line: widen the window")


def test_a_reduced_debug_screen_fails_with_its_remedy() -> None:
    seen = rows(snapshot(Reading(problem="reduced: switch it off"), "unknown", "Chunk-relative:"))
    assert seen["reduced debug info"][0] == seen["position line"][0] == "fail"
    assert "gamerule" in seen["position line"][2]


@pytest.mark.parametrize(
    ("pitch", "version", "status", "fix"),
    [
        (30.0, "1.21.9", "fail", "press F3+F6 in the game, and set looking_at_block to In F3"),
        (30.0, "1.21.11", "fail", "press F3+F6 in the game, and set looking_at_block to In Overlay"),
        (30.0, "26.1", "fail", "press F3+F6 in the game, and set looking_at_block_state to In Overlay"),
        (30.0, "1.21.8", "fail", "stand on solid ground, out of the water"),
        (29.9, "1.21.8", "skip", "look down at the ground, and run this again"),
        (29.9, "1.21.9", "fail", "look down at the ground, and run this again"),
        (30.0, "", "fail", switch_on(None)),
        (None, "1.21.9", "skip", ""),
    ],
)
def test_missing_looked_at_line_fails_if_the_ground_is_in_view_or_the_entry_may_be_off(
    pitch: float | None, version: str, status: str, fix: str
) -> None:
    row = rows(snapshot(Reading(xyz=(0.5, 64.0, 0.5), yaw=0.0, pitch=pitch), version=version))["looked-at line"]
    assert (row[0], row[2]) == (status, fix)


@pytest.mark.parametrize(
    ("known", "text", "is_fault"),
    [
        (None, "reducedDebugInfo:true\n", True),
        ("skip", "reducedDebugInfo:true\n", True),
        ("skip", "reducedDebugInfo:false\n", False),
        ("pass", "reducedDebugInfo:true\n", False),
    ],
)
def test_reduced_debug_info_option_counts_only_if_no_debug_screen_was_seen(
    known: str | None, text: str, is_fault: bool
) -> None:
    name = CheckName.REDUCED_DEBUG_INFO
    checks = {name: Check(name, "pass" if known == "pass" else "skip", "")} if known else {}
    row = reduced_by_options(parse_options(text.encode(), Path("options.txt")), checks)
    assert (row is not None and row.status == "fail") == is_fault


FONT = font_of(drawn_atlas())
WINDOW = Fingerprint("Minecraft 26.3", (854, 480))


@pytest.fixture(scope="module")
def shown() -> Frame:
    frame: Frame = started(VirtualClient()).display.grab()
    return frame


def levelled(frame: Frame, darkest: float, brightest: float) -> Frame:
    """Return the frame with its levels squeezed into that range."""
    found: Frame = (darkest + frame.astype(np.float32) * (brightest - darkest) / 255).astype(np.uint8)
    return found


@pytest.mark.parametrize("level", [0, BLACK])
def test_black_picture_is_reported_with_its_likely_causes(shown: Frame, level: int) -> None:
    fault = picture_fault(np.full_like(shown, level), FONT)
    assert fault is not None
    assert fault.startswith("the window's picture is black: play in a window")
    assert "remote" in fault


@pytest.mark.parametrize(
    ("darkest", "brightest", "says"),
    [(0, 200, FAINT), (0, 120, FAINT), (40, 180, FAINT), (0, 225, FAINT), (90, 255, BRIGHT)],
)
def test_text_that_is_too_faint_or_too_bright_is_reported_with_hdr_as_a_cause(
    darkest: int, brightest: int, says: str, shown: Frame
) -> None:
    fault = picture_fault(levelled(shown, darkest, brightest), FONT)
    assert fault is not None
    assert fault.startswith(f"{says}: switch HDR")


def test_picture_without_text_has_no_known_fault() -> None:
    frame = started(VirtualClient(has_f3=False)).display.grab()
    assert picture_fault(frame, FONT) is None
    assert picture_fault(np.full_like(frame, 128), FONT) is None


def test_debug_screen_row_reports_a_black_picture(shown: Frame) -> None:
    contents = ScreenContents("unknown", None, None, Reading(problem="no debug screen: press F3"))
    rows = [
        screen_rows(WindowSnapshot(WINDOW, (854, 480), None, True, contents, picture), FONT)[0]
        for picture in (np.zeros_like(shown), np.full_like(shown, 128))
    ]
    assert [(row.name, row.status) for row in rows] == [(CheckName.DEBUG_SCREEN, "fail")] * 2
    assert [row.detail for row in rows] == ["the window's picture is black", "no debug screen"]


Size = tuple[int, int]


def snapshot_of_size(picture_size: Size, points: Size | None, gui_scale: int | None = 2) -> WindowSnapshot:
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
def test_scaling_row_compares_the_picture_size_with_the_windows_points(
    picture_size: Size, points: Size | None, status: str, detail: str
) -> None:
    row = scaling_row(snapshot_of_size(picture_size, points))
    assert (row.status, row.detail) == (status, detail)
    assert bool(row.fix) == (status in ("warn", "fail"))


@pytest.mark.parametrize(
    ("size", "scale", "status"),
    [((854, 480), 2, "warn"), ((1280, 720), 3, "warn"), ((959, 540), 2, "pass"), ((958, 540), 2, "warn")],
)
def test_window_narrower_than_480_gui_pixels_is_a_warning(size: Size, scale: int, status: str) -> None:
    row = size_row(snapshot_of_size(size, None, scale), None)
    assert row.status == status
    assert row.fix.startswith("" if status == "pass" else f"make the window at least {480 * scale} pixels wide")
    assert bool(row.fix) == (status == "warn")


def test_window_smaller_than_320_x_240_fails_the_size_row() -> None:
    assert size_row(snapshot_of_size((319, 480), None), None).status == "fail"
    assert size_row(snapshot_of_size((320, 240), None, gui_scale=1), None).status == "warn"
    assert size_row(snapshot_of_size((320, 240), None, gui_scale=None), None).status == "skip"
    assert size_row(snapshot_of_size((320, 239), None), None).fix == "make the window larger than 320 x 240"


@pytest.mark.parametrize(("wanted", "status"), [(2, "pass"), (None, "pass"), (3, "fail")])
def test_gui_scale_that_differs_from_the_profiles_debug_scale_fails(wanted: int | None, status: str) -> None:
    row = size_row(snapshot_of_size((960, 540), None), Profile(screen=ScreenTable(debug_scale=wanted)))
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
def test_the_scaling_may_differ_from_a_whole_number_by_a_hundredth(pictured: Size, status: str) -> None:
    assert scaling_row(snapshot_of_size(pictured, (854, 480))).status == status


def test_another_window_in_front_fails_its_row() -> None:
    behind = WindowSnapshot(
        Fingerprint("Minecraft", (854, 480), None), (854, 480), None, is_in_front=False, contents=None
    )
    assert front_row(behind).status == "fail"
    assert front_row(snapshot_of_size((854, 480), None)).status == "pass"
    rows = window_rows(snapshot_of_size((854, 480), None), None)
    assert [row.name.value for row in rows] == ["game's window", "in front", "display scaling", "size and GUI scale"]


def test_version_later_than_all_known_ones_is_a_warning_with_advice() -> None:
    row = window_row("Minecraft 27.1 - Singleplayer")
    assert (row.status, row.detail.startswith("Minecraft 27.1 is later than 26.4")) == ("warn", True)
    assert row.fix.startswith("look in the calibration's report")
    assert window_row("Minecraft 26.4").status == "pass"
    assert window_row("A pack of mods 99").status == "pass"
