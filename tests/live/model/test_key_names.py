"""The names of keys."""

import pytest

from mc_nested.errors import ProfileError
from mc_nested.live.model.key_names import canonical, check_key, is_key, place_of
from mc_nested.live.model.key_places import PLACES


@pytest.mark.parametrize("key", ["W", "escape", "caps_lock", "page_down", *PLACES])
def test_every_place_and_every_other_name_of_one_names_a_key(key: str) -> None:
    assert is_key(key)
    check_key(key)


@pytest.mark.parametrize("key", ["", "shift", "f33", "ctrl+a", "Enter", "é", "?", "я"])
def test_an_unknown_key_is_an_error(key: str) -> None:
    assert not is_key(key)
    for ask in (check_key, place_of):
        with pytest.raises(ProfileError, match="no key is named"):
            ask(key)


@pytest.mark.parametrize(("one", "other"), [("W", "w"), ("escape", "esc"), ("page_up", "page.up")])
def test_two_names_of_a_key_have_one_place(one: str, other: str) -> None:
    assert canonical(one) == other
    assert place_of(one) is place_of(other) is PLACES[other]


def test_a_name_that_means_no_key_stays_as_it_is() -> None:
    assert canonical("left button") == "left button"
