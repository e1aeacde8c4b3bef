"""The debug screen's checks, by what the window shows."""

from pathlib import Path

import pytest

from calibration.doctor.check import Check, CheckName
from calibration.doctor.screen_rows import SCREEN_CHECKS, reduced_by_options, screen_rows
from calibration.doctor.snapshot import ScreenContents, WindowSnapshot
from calibration.installation.options_txt import parse_options
from mc_nested.live.menus.screens import ScreenName
from mc_nested.live.model.debug_entries import switch_on
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.model.scales import Scales
from mc_nested.live.profile.fingerprint import Fingerprint

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
def test_what_can_not_be_checked_is_skipped(is_in_front: bool, reason: str) -> None:
    unseen = WindowSnapshot(Fingerprint("Minecraft", (854, 480), None), (854, 480), None, is_in_front, None)
    checks = screen_rows(unseen, None)
    assert [check.name for check in checks] == list(SCREEN_CHECKS)
    assert all(check.status == "skip" and check.detail.startswith(reason) for check in checks)


def test_without_a_debug_screen_the_screen_that_is_there_is_named() -> None:
    pause = rows(snapshot(Reading(problem="no XYZ line: press F3"), "pause", None))
    assert pause["debug screen"] == ("fail", "the Game Menu is open", "click Back to Game")
    assert {status for status, _, _ in list(pause.values())[1:]} == {"skip"}
    unknown = rows(snapshot(Reading(problem="no XYZ line: press F3"), "unknown", None))
    assert unknown["debug screen"] == ("fail", "no XYZ line", "press F3")


def test_an_open_chat_is_closed_with_esc() -> None:
    assert rows(snapshot(READ, "chat"))["debug screen"] == ("fail", "the chat is open", "press Esc")


def test_a_problem_counts_only_of_a_debug_screen_with_its_position() -> None:
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
def test_a_missing_looked_at_line_is_a_fault_with_the_ground_in_view_or_where_it_may_be_off(
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
def test_an_option_that_reduces_it_counts_where_no_debug_screen_was_seen(
    known: str | None, text: str, is_fault: bool
) -> None:
    name = CheckName.REDUCED_DEBUG_INFO
    checks = {name: Check(name, "pass" if known == "pass" else "skip", "")} if known else {}
    row = reduced_by_options(parse_options(text.encode(), Path("options.txt")), checks)
    assert (row is not None and row.status == "fail") == is_fault
