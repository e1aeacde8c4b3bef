"""Which key makes a symbol, for a game that goes by symbols."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.key_places import PLACES
from mc_nested.live.model.key_symbols import CHARACTERS, KeyStroke, missing_keys, stroke_for, taken_for
from mc_nested.live.profile.tables import KeysTable
from sim.client.desktop.layouts import LAYOUTS, characters_of, taken_by_lwjgl

WALKING = ("w", "a", "s", "d", "t")
WITHOUT_LATIN_LETTERS = ("ru", "gr", "il")
WITH_DIGITS_ABOVE = ("fr", "be", "cz")


def test_the_us_layout_has_every_key_at_its_place_that_lwjgl_2_knows_on_x11() -> None:
    layout = taken_by_lwjgl(characters_of("us"))
    assert [key for key in PLACES if stroke_for(key, layout) != KeyStroke(key)] == ["\\"]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_layout_has_every_key_of_the_profile_or_lacks_its_letters(layout: str) -> None:
    missing = missing_keys(KeysTable().pressed(), taken_by_lwjgl(characters_of(layout)))
    assert missing == (["w", "s", "a", "d", "t"] if layout in WITHOUT_LATIN_LETTERS else [])


@pytest.mark.parametrize("layout", LAYOUTS)
def test_only_a_digit_above_another_character_takes_shift(layout: str) -> None:
    made = taken_by_lwjgl(characters_of(layout))
    with_shift = {key for key in CHARACTERS if (stroke := stroke_for(key, made)) and stroke.takes_shift}
    assert with_shift == (set("1234567890") if layout in WITH_DIGITS_ABOVE else set())


def test_a_letter_above_another_one_is_none() -> None:
    assert stroke_for("w", {"w": ("'", "w")}) is None


def test_a_key_of_a_word_is_where_it_is_under_every_layout() -> None:
    assert stroke_for("left.shift", {}) == KeyStroke("left.shift")
    assert stroke_for("escape", {}) == KeyStroke("esc")


@given(layout=st.sampled_from(LAYOUTS), key=st.sampled_from(sorted(CHARACTERS)))
def test_what_is_pressed_is_taken_for_the_key_that_was_meant(layout: str, key: str) -> None:
    made = taken_by_lwjgl(characters_of(layout))
    stroke = stroke_for(key, made)
    if stroke is None:
        assert all(plain != key for plain, _ in made.values())
    else:
        assert taken_for(stroke.place, made, has_shift=stroke.takes_shift) == key
