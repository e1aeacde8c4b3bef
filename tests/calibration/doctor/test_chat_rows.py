"""The options on which it depends that a command can be typed and read."""

from pathlib import Path

import pytest

from calibration.doctor.chat_rows import CHAT_CHECKS, chat_mends, chat_rows
from calibration.doctor.check import Check, CheckName
from calibration.installation.options_txt import OptionsTxt, parse_options
from tests.calibration.doctor.examined import GOOD


def options(before: str = "", after: str = "") -> OptionsTxt:
    return parse_options(GOOD.replace(before, after).encode(), Path("options.txt"))


def row_of(name: CheckName, of: OptionsTxt) -> Check:
    return next(row for row in chat_rows(of) if row.name == name)


def test_the_games_own_values_pass_and_a_file_without_them_says_nothing() -> None:
    assert [(row.name, row.status) for row in chat_rows(options())] == [(name, "pass") for name in CHAT_CHECKS]
    bare = parse_options(b"lang:en_us\n", Path("options.txt"))
    assert {row.status for row in chat_rows(bare)} == {"skip"}
    assert chat_mends(options()) == chat_mends(bare) == {}


@pytest.mark.parametrize(("value", "status"), [("0", "pass"), ("1", "pass"), ("2", "fail"), ("hidden", "fail")])
def test_a_chat_that_is_hidden_takes_no_command(value: str, status: str) -> None:
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
def test_a_faint_ground_behind_what_is_typed_counts_where_it_is_not_the_chats_alone(
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
def test_a_key_for_friends_that_a_command_may_hold_loses_its_key(key: str, status: str, detail: str) -> None:
    changed = options("friends:key.keyboard.unknown", f"friends:key.keyboard.{key}")
    row = row_of(CheckName.FRIENDS_KEY, changed)
    assert (row.status, row.detail) == (status, detail)
    assert chat_mends(changed) == ({"key_key.friends": "key.keyboard.unknown"} if status == "warn" else {})


def test_every_row_that_is_not_passed_says_what_to_do_in_the_game_and_beside_it() -> None:
    bad = options().with_values({"chatVisibility": "2", "textBackgroundOpacity": "0", "backgroundForChatOnly": "false"})
    rows = chat_rows(bad.with_values({"key_key.friends": "key.keyboard.o"}))
    assert [row.status for row in rows] == ["fail", "warn", "warn"]
    assert all(row.fix.startswith("Options > ") and "mc-nested doctor --fix" in row.fix for row in rows)
