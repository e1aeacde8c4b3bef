"""options.txt: read in every version's form, patched without touching another byte, refused where it is none."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.doctor.options_rows import SAFE
from calibration.installation.options_txt import OptionsTxt, key_name, load_options, parse_options
from mc_nested.errors import ProfileError

HERE = Path("options.txt")

NEW = """version:3465
autoJump:true
fullscreen:false
guiScale:3
lang:fr_fr
pauseOnLostFocus:true
resourcePacks:["vanilla","file/Faithful: 32x.zip"]
key_key.forward:key.keyboard.z
key_key.sneak:key.keyboard.left.control
key_key.use:key.mouse.right
key_key.hotbar.1:key.keyboard.1
key_key.swapOffhand:key.keyboard.unknown
key_key.debug.overlay:key.keyboard.f3
"""

OLD = (
    "invertYMouse:false\r\nguiScale:0\r\nlang:en_us\r\npauseOnLostFocus:false\r\nautoJump:false\r\n"
    "key_key.attack:-100\r\nkey_key.use:-99\r\nkey_key.forward:17\r\nkey_key.left:30\r\nkey_key.back:31\r\n"
    "key_key.right:32\r\nkey_key.sneak:42\r\nkey_key.chat:20\r\nkey_key.command:53\r\nkey_key.hotbar.1:2\r\n"
    "key_key.hotbar.9:10\r\nkey_key.spectatorOutlines:0\r\n"
)


def options(text: str) -> OptionsTxt:
    return parse_options(text.encode(), HERE)


def test_the_options_of_a_new_version_are_read() -> None:
    read = options(NEW)
    assert read.values["guiScale"] == "3"
    assert read.values["resourcePacks"] == '["vanilla","file/Faithful: 32x.zip"]'
    keys = {action: read.key(action) for action in ("forward", "sneak", "use", "hotbar.1", "swapOffhand", "chat")}
    assert keys == {
        "forward": "z",
        "sneak": "left.control",
        "use": "right button",
        "hotbar.1": "1",
        "swapOffhand": "",
        "chat": None,
    }
    assert read.key("debug.overlay") == "f3"


def test_key_numbers_of_1_12_are_read_as_the_same_key_names() -> None:
    read = options(OLD)
    actions = ("attack", "use", "forward", "left", "back", "right", "sneak", "chat", "command", "hotbar.1", "hotbar.9")
    assert [read.key(action) for action in actions] == [
        *("left button", "right button", "w", "a", "s", "d", "left.shift", "t", "/", "1", "9")
    ]
    assert read.key("spectatorOutlines") == ""
    assert read.values["lang"] == "en_us"  # the line's end is no part of it


@pytest.mark.parametrize(
    ("value", "name"),
    [
        ("key.keyboard.w", "w"),
        ("key.keyboard.semicolon", ";"),
        ("key.keyboard.page.up", "page.up"),
        ("key.keyboard.f12", "f12"),
        ("key.keyboard.escape", "escape"),
        ("key.mouse.middle", "middle button"),
        ("key.keyboard.keypad.7", None),
        ("key.mouse.4", None),
        ("scancode.86", None),
        ("key.keyboard.w:NONE", "w"),
        ("key.keyboard.w:CONTROL", None),
        ("11", "0"),
        ("57", "space"),
        ("61", "f3"),
        ("88", "f12"),
        ("30:SHIFT", None),
        ("999", None),
        ("", None),
    ],
)
def test_key_codes_are_translated_to_the_key_names_of_profiles(value: str, name: str | None) -> None:
    assert key_name(value) == name


def test_last_value_of_a_repeated_option_counts() -> None:
    assert options("autoJump:false\nautoJump:true\n").values["autoJump"] == "true"


def test_safe_values_change_their_lines_and_nothing_else() -> None:
    read = options(NEW)
    assert read.changes(SAFE) == {
        "pauseOnLostFocus": ("true", "false"),
        "autoJump": ("true", "false"),
        "lang": ("fr_fr", "en_us"),
    }
    patched = b"".join(read.with_values(SAFE).lines).decode()
    assert patched == NEW.replace("autoJump:true", "autoJump:false").replace("fr_fr", "en_us").replace(
        "pauseOnLostFocus:true", "pauseOnLostFocus:false"
    )


def test_a_patched_file_of_1_12_keeps_its_line_ends() -> None:
    read = options(OLD.replace("pauseOnLostFocus:false", "pauseOnLostFocus:true"))
    assert b"".join(read.with_values(SAFE).lines) == OLD.encode()


def test_last_line_without_a_line_end_gets_none() -> None:
    assert options("lang:de_de\nautoJump:true").with_values(SAFE).lines == (b"lang:en_us\n", b"autoJump:false")


LINES = st.lists(
    st.one_of(
        st.binary(max_size=12).map(lambda data: data.replace(b"\n", b"").replace(b"\r", b"")),
        st.sampled_from([b"autoJump:true", b"autoJump:false", b"lang:fr_fr", b"key_key.left:30", "mod:é".encode()]),
    ),
    max_size=12,
)


@given(LINES, st.sampled_from([b"\n", b"\r\n"]))
def test_patching_one_option_leaves_all_other_bytes_unchanged(lines: list[bytes], end: bytes) -> None:
    read = OptionsTxt(HERE, tuple(line + end for line in lines))
    patched = read.with_values({"autoJump": "false"})
    assert patched.lines == tuple(
        (b"autoJump:false" if line.startswith(b"autoJump:") else line) + end for line in lines
    )
    assert not patched.changes({"autoJump": "false"})
    assert patched.with_values({"autoJump": "false"}) == patched


@pytest.mark.parametrize("data", [b"", b"\n\n", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"<html>\n<body>\n", bytes(200)])
def test_a_file_without_options_is_refused(data: bytes) -> None:
    with pytest.raises(ProfileError, match=r"options.txt: doesn't hold the game's options: move it away"):
        parse_options(data, HERE)


def test_a_file_that_can_not_be_read_is_a_one_line_error(tmp_path: Path) -> None:
    for path in (tmp_path / "missing.txt", tmp_path):
        with pytest.raises(ProfileError, match="can't be read") as caught:
            load_options(path)
        assert "\n" not in str(caught.value)


def test_options_file_that_is_not_utf_8_is_kept_byte_for_byte(tmp_path: Path) -> None:
    file = tmp_path / "options.txt"
    file.write_bytes(OLD.encode() + b"key_mod:\xff\xfe\n")
    assert b"".join(load_options(file).lines) == file.read_bytes()
