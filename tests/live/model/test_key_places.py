"""The table of places: each key once, in every system's numbers."""

import pytest

from mc_nested.live.model.key_places import NAME_AT_EVDEV, NAME_AT_MAC, NAME_AT_SCAN, PLACES, KeyPlace

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
def test_a_place_has_the_numbers_of_each_systems_own_table(name: str, place: KeyPlace) -> None:
    assert PLACES[name] == place


@pytest.mark.parametrize("names", [NAME_AT_EVDEV, NAME_AT_SCAN, NAME_AT_MAC], ids=["evdev", "scancodes", "macOS"])
def test_no_two_places_share_a_number(names: dict[int, str]) -> None:
    assert sorted(names.values()) == sorted(PLACES)
