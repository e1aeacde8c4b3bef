"""The table of places: each key once, in every system's numbers.

The names of keys.

Which key makes a symbol, for a game that goes by symbols.
"""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import ProfileError
from mc_nested.live.model.keys import (
    CHARACTERS,
    NAME_AT_EVDEV,
    NAME_AT_MAC,
    NAME_AT_SCAN,
    PLACES,
    KeyPlace,
    KeyStroke,
    canonical,
    check_key,
    is_key,
    missing_keys,
    place_of,
    stroke_for,
    taken_for,
)
from mc_nested.live.profile.tables import KeysTable
from sim.client.desktop.keyboard import LAYOUTS, characters_of, taken_by_lwjgl

US_KEYS = "`1234567890-=qwertyuiop[]\\asdfghjkl;'zxcvbnm,./"


def test_every_character_that_a_us_keyboard_types_without_shift_has_a_place() -> None:
    assert sorted(name for name in PLACES if len(name) == 1) == sorted(US_KEYS)


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("w", KeyPlace(evdev=17, scan=0x11, mac=0x0D)),
        ("a", KeyPlace(evdev=30, scan=0x1E, mac=0x00)),
        ("1", KeyPlace(evdev=2, scan=0x02, mac=0x12)),
        ("/", KeyPlace(evdev=53, scan=0x35, mac=0x2C)),
        ("`", KeyPlace(evdev=41, scan=0x29, mac=0x32)),
        ("\\", KeyPlace(evdev=43, scan=0x2B, mac=0x2A)),
        ("m", KeyPlace(evdev=50, scan=0x32, mac=0x2E)),
        ("left.shift", KeyPlace(evdev=42, scan=0x2A, mac=0x38)),
        ("right.shift", KeyPlace(evdev=54, scan=0x36, mac=0x3C)),
        ("right.control", KeyPlace(evdev=97, scan=0xE01D, mac=0x3E)),
        ("f3", KeyPlace(evdev=61, scan=0x3D, mac=0x63)),
        ("f10", KeyPlace(evdev=68, scan=0x44, mac=0x6D)),
        ("f11", KeyPlace(evdev=87, scan=0x57, mac=0x67)),
        ("f12", KeyPlace(evdev=88, scan=0x58, mac=0x6F)),
        ("f13", KeyPlace(evdev=183, scan=0x64, mac=0x69)),
        ("f20", KeyPlace(evdev=190, scan=0x6B, mac=0x5A)),
        ("up", KeyPlace(evdev=103, scan=0xE048, mac=0x7E)),
        ("delete", KeyPlace(evdev=111, scan=0xE053, mac=0x75)),
        ("left.win", KeyPlace(evdev=125, scan=0xE05B, mac=0x37)),
    ],
)
def test_each_place_has_its_keycodes_for_all_three_systems(name: str, place: KeyPlace) -> None:
    assert PLACES[name] == place


@pytest.mark.parametrize("names", [NAME_AT_EVDEV, NAME_AT_SCAN, NAME_AT_MAC], ids=["evdev", "scancodes", "macOS"])
def test_no_two_places_share_a_number(names: dict[int, str]) -> None:
    assert sorted(names.values()) == sorted(PLACES)


@pytest.mark.parametrize("key", ["W", "escape", "caps_lock", "page_down", *PLACES])
def test_every_place_and_every_synonym_names_a_key(key: str) -> None:
    assert is_key(key)
    check_key(key)


@pytest.mark.parametrize("key", ["", "shift", "f33", "ctrl+a", "Enter", "é", "?", "я"])
def test_an_unknown_key_is_an_error(key: str) -> None:
    assert not is_key(key)
    for ask in (check_key, place_of):
        with pytest.raises(ProfileError, match="no key is named"):
            ask(key)


@pytest.mark.parametrize(("one", "other"), [("W", "w"), ("escape", "esc"), ("page_up", "page.up")])
def test_synonyms_of_a_key_have_the_same_place(one: str, other: str) -> None:
    assert canonical(one) == other
    assert place_of(one) is place_of(other) is PLACES[other]


def test_canonical_leaves_a_mouse_buttons_name_unchanged() -> None:
    assert canonical("left button") == "left button"


WALKING = ("w", "a", "s", "d", "t")
WITHOUT_LATIN_LETTERS = ("ru", "gr", "il")
WITH_DIGITS_ABOVE = ("fr", "be", "cz")


def test_the_us_layout_has_every_key_but_the_backslash_at_its_own_place() -> None:
    layout = taken_by_lwjgl(characters_of("us"))
    assert [key for key in PLACES if stroke_for(key, layout) != KeyStroke(key)] == ["\\"]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_only_layouts_without_latin_letters_lack_keys_of_the_default_profile(layout: str) -> None:
    missing = missing_keys(KeysTable().pressed(), taken_by_lwjgl(characters_of(layout)))
    assert missing == (["w", "s", "a", "d", "t"] if layout in WITHOUT_LATIN_LETTERS else [])


@pytest.mark.parametrize("layout", LAYOUTS)
def test_only_digits_above_another_character_take_shift(layout: str) -> None:
    made = taken_by_lwjgl(characters_of(layout))
    with_shift = {key for key in CHARACTERS if (stroke := stroke_for(key, made)) and stroke.takes_shift}
    assert with_shift == (set("1234567890") if layout in WITH_DIGITS_ABOVE else set())


def test_a_letter_above_another_character_is_not_reached_with_shift() -> None:
    assert stroke_for("w", {"w": ("'", "w")}) is None


def test_keys_named_by_a_word_stay_at_their_place_under_every_layout() -> None:
    assert stroke_for("left.shift", {}) == KeyStroke("left.shift")
    assert stroke_for("escape", {}) == KeyStroke("esc")


@given(layout=st.sampled_from(LAYOUTS), key=st.sampled_from(sorted(CHARACTERS)))
def test_lwjgl_2_takes_each_stroke_for_the_key_that_was_meant(layout: str, key: str) -> None:
    made = taken_by_lwjgl(characters_of(layout))
    stroke = stroke_for(key, made)
    if stroke is None:
        assert all(plain != key for plain, _ in made.values())
    else:
        assert taken_for(stroke.place, made, has_shift=stroke.takes_shift) == key
