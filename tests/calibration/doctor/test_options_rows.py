"""The rows of options.txt, value by value.

The options that decide whether a command can be typed and read.
"""

from pathlib import Path

import pytest

from calibration.doctor.check import Check, CheckName
from calibration.doctor.options_rows import (
    CHAT_CHECKS,
    OPTION_CHECKS,
    chat_mends,
    chat_rows,
    debug_scale_row,
    gui_scale_row,
    keys_row,
    option_rows,
)
from calibration.installation.options_txt import OptionsTxt, parse_options
from mc_nested.live.profile.tables import KeysTable
from tests.calibration.doctor.examined import GOOD


@pytest.mark.parametrize(
    ("value", "window", "status", "detail"),
    [
        ("2", None, "pass", "2"),
        ("4", (854, 480), "pass", "4, 2 in this window"),
        ("2", (854, 480), "pass", "2"),
        ("0", None, "warn", "Auto: with the window's size it changes too"),
        ("0", (854, 480), "warn", "Auto, 2 in this window: with its size it changes too"),
        ("0", (2560, 1440), "warn", "Auto, 6 in this window: with its size it changes too"),
        ("0", (3840, 2160), "fail", "Auto, 9 in this window: 8 at most can be read"),
        ("9", None, "fail", "9: 8 at most"),
        ("6", (2560, 1440), "pass", "6"),
        ("6", (1280, 720), "pass", "6, 3 in this window"),
        ("4", (2560, 1440), "pass", "4"),
        ("9", (3840, 2160), "fail", "9, 9 in this window: 8 at most can be read"),
        ("4", None, "pass", "4"),
        ("8", None, "pass", "8"),
        (None, None, "skip", "the file doesn't say"),
        ("large", None, "skip", "the file doesn't say"),
    ],
)
def test_gui_scale_row_judges_the_scale_that_the_window_gets(
    value: str | None, window: tuple[int, int] | None, status: str, detail: str
) -> None:
    row = gui_scale_row(value, window)
    assert (row.status, row.detail) == (status, detail)
    assert bool(row.fix) == (status in ("warn", "fail"))


def bound(change: tuple[str, str], keys: KeysTable) -> tuple[str, str]:
    row = keys_row(parse_options(GOOD.replace(*change).encode(), Path("options.txt")), keys)
    return row.status, row.detail


@pytest.mark.parametrize(
    ("change", "keys", "status", "detail"),
    [
        (("", ""), KeysTable(), "pass", "12 are as the profile has them"),
        (("board.t", "board.enter"), KeysTable(), "fail", "chat: enter for t"),
        (("board.w", "board.z"), KeysTable(forward="z"), "pass", "12 are as the profile has them"),
        # On an AZERTY keyboard the key at that place is printed z: nothing need be wrong.
        (("", ""), KeysTable(forward="z"), "warn", "forward: w for z"),
        (("mouse.right", "mouse.left"), KeysTable(), "fail", "use: left button for right button"),
        (("board.left.shift", "board.unknown"), KeysTable(), "fail", "sneak: no key for left.shift"),
        (("board.left.shift", "board.keypad.1"), KeysTable(), "fail", "sneak: another key for left.shift"),
        (("board.1", "board.2"), KeysTable(), "warn", "hotbar.1: 2 for 1"),
        (("modifier:key.keyboard.f3", "modifier:key.keyboard.f4"), KeysTable(), "fail", "debug.modifier: f4 for f3"),
        (("overlay:key.keyboard.f3", "overlay:key.keyboard.f4"), KeysTable(), "fail", "debug.overlay: f4 for f3"),
        (
            ("copyLocation:key.keyboard.c", "copyLocation:key.keyboard.v"),
            KeysTable(),
            "warn",
            "debug.copyLocation: v for c",
        ),
    ],
)
def test_keys_row_compares_the_keys_in_options_txt_with_the_profiles(
    change: tuple[str, str], keys: KeysTable, status: str, detail: str
) -> None:
    assert bound(change, keys) == (status, detail)


def test_keys_row_is_skipped_if_the_file_has_no_keys() -> None:
    assert keys_row(parse_options(b"lang:en_us\n", Path("options.txt")), KeysTable()).status == "skip"


def test_every_option_has_its_row_whether_there_is_a_file_or_not() -> None:
    for options in (None, parse_options(b"lang:en_us\n", Path("options.txt")), parse_options(GOOD.encode(), Path("o"))):
        assert {row.name for row in option_rows(options, KeysTable(), None)} == set(OPTION_CHECKS)
    assert set(OPTION_CHECKS) < set(CheckName)


@pytest.mark.parametrize(
    ("name", "status"),
    [
        (CheckName.PAUSE_ON_LOST_FOCUS, "warn"),
        (CheckName.AUTO_JUMP, "fail"),
        (CheckName.FORCE_UNICODE_FONT, "fail"),
        (CheckName.FULLSCREEN, "warn"),
        (CheckName.TOGGLE_CROUCH, "fail"),
        (CheckName.TOGGLE_ATTACK, "fail"),
        (CheckName.TOGGLE_USE, "fail"),
        (CheckName.SAVE_CHAT_DRAFTS, "warn"),
    ],
)
def test_switch_that_should_be_off_fails_or_warns_with_a_reason_and_a_fix(name: CheckName, status: str) -> None:
    text = GOOD.replace(f"{name}:false", f"{name}:true")
    rows = {row.name: row for row in option_rows(parse_options(text.encode(), Path("o")), KeysTable(), None)}
    assert rows[name].status == status
    assert rows[name].detail.startswith("true: ")
    assert "mc-nested doctor --fix" in rows[name].fix
    assert {row.status for row in rows.values() if row.name != name} == {"pass"}


@pytest.mark.parametrize(
    ("value", "status"), [("en_us", "pass"), ("en_US", "pass"), ("en_gb", "pass"), ("fr_fr", "warn")]
)
def test_language_other_than_english_is_a_warning(value: str, status: str) -> None:
    text = GOOD.replace("lang:en_us", f"lang:{value}")
    rows = {row.name: row for row in option_rows(parse_options(text.encode(), Path("o")), KeysTable(), None)}
    assert rows[CheckName.LANGUAGE].status == status


@pytest.mark.parametrize(
    ("value", "gui", "window", "status", "detail"),
    [
        (None, "2", (854, 480), "skip", "the file doesn't say: this version may not have it"),
        ("0", "0", (854, 480), "pass", "Auto, 1 in this window"),
        ("0", "0", (1920, 1080), "pass", "Auto, 2 in this window"),
        ("0", "1", (1920, 1080), "pass", "Auto, 1 in this window"),
        ("0", "0", (640, 479), "pass", "Auto, 1 in this window"),
        ("0", "3", (2560, 1440), "pass", "Auto, 3 in this window"),
        ("-1", "2", (854, 480), "pass", "-1, as the GUI scale, 2 in this window"),
        ("1", "4", (1920, 1080), "pass", "1, 1 in this window"),
        ("7", "2", (1920, 1080), "pass", "7, 2 in this window"),
        ("3", None, (1920, 1080), "pass", "3"),
        ("0", "0", None, "pass", "Auto"),
        ("-2", "2", None, "warn", "-2, which is no scale"),
        ("half", "2", None, "warn", "half, which is no scale"),
        ("", "2", None, "warn", ", which is no scale"),
    ],
)
def test_any_valid_debug_screen_scale_passes(
    value: str | None, gui: str | None, window: tuple[int, int] | None, status: str, detail: str
) -> None:
    row = debug_scale_row(value, gui, window)
    assert (row.status, row.detail) == (status, detail)
    assert bool(row.fix) == (status == "warn")


def options(before: str = "", after: str = "") -> OptionsTxt:
    return parse_options(GOOD.replace(before, after).encode(), Path("options.txt"))


def row_of(name: CheckName, of: OptionsTxt) -> Check:
    return next(row for row in chat_rows(of) if row.name == name)


def test_default_chat_options_pass_and_missing_ones_are_skipped() -> None:
    assert [(row.name, row.status) for row in chat_rows(options())] == [(name, "pass") for name in CHAT_CHECKS]
    bare = parse_options(b"lang:en_us\n", Path("options.txt"))
    assert {row.status for row in chat_rows(bare)} == {"skip"}
    assert chat_mends(options()) == chat_mends(bare) == {}


@pytest.mark.parametrize(("value", "status"), [("0", "pass"), ("1", "pass"), ("2", "fail"), ("hidden", "fail")])
def test_hidden_chat_fails_its_row_and_is_mended(value: str, status: str) -> None:
    changed = options("chatVisibility:0", f"chatVisibility:{value}")
    assert row_of(CheckName.CHAT_VISIBILITY, changed).status == status
    assert chat_mends(changed) == ({"chatVisibility": "0"} if status == "fail" else {})


@pytest.mark.parametrize(
    ("opacity", "only", "status"),
    [
        *(("0.0", "true", "pass"), ("0.0", "false", "warn"), ("0.3", "false", "warn"), ("0.31", "false", "pass")),
        *(("1.0", "false", "pass"), ("faint", "false", "skip")),
    ],
)
def test_faint_text_background_is_a_warning_unless_it_is_for_the_chat_only(
    opacity: str, only: str, status: str
) -> None:
    lines = ("textBackgroundOpacity:0.5\nbackgroundForChatOnly:true", f"textBackgroundOpacity:{opacity}\n{only}")
    changed = options(lines[0], lines[1].replace(f"\n{only}", f"\nbackgroundForChatOnly:{only}"))
    assert row_of(CheckName.TEXT_BACKGROUND, changed).status == status
    assert chat_mends(changed) == ({"backgroundForChatOnly": "true"} if status == "warn" else {})


@pytest.mark.parametrize(
    ("key", "status", "detail"),
    [
        ("o", "warn", "o: a command that the chat misses would open the list of friends"),
        ("slash", "warn", "/: a command that the chat misses would open the list of friends"),
        ("unknown", "pass", "no key"),
        ("f9", "pass", "f9"),
        ("keypad.1", "pass", "key.keyboard.keypad.1"),
    ],
)
def test_friends_key_that_a_command_may_contain_is_a_warning_and_is_unbound(key: str, status: str, detail: str) -> None:
    changed = options("friends:key.keyboard.unknown", f"friends:key.keyboard.{key}")
    row = row_of(CheckName.FRIENDS_KEY, changed)
    assert (row.status, row.detail) == (status, detail)
    assert chat_mends(changed) == ({"key_key.friends": "key.keyboard.unknown"} if status == "warn" else {})


def test_chat_rows_that_do_not_pass_name_the_games_option_and_doctor_fix() -> None:
    bad = options().with_values({"chatVisibility": "2", "textBackgroundOpacity": "0", "backgroundForChatOnly": "false"})
    rows = chat_rows(bad.with_values({"key_key.friends": "key.keyboard.o"}))
    assert [row.status for row in rows] == ["fail", "warn", "warn"]
    assert all(row.fix.startswith("Options > ") and "mc-nested doctor --fix" in row.fix for row in rows)
