"""The names of keys."""

import pytest

from mc_nested.errors import ProfileError
from mc_nested.live.model.key_names import WORDS, check_key


@pytest.mark.parametrize("key", ["w", "/", "1", "é", *WORDS])
def test_every_character_and_every_word_of_the_table_names_a_key(key: str) -> None:
    check_key(key)


@pytest.mark.parametrize("key", ["", "shift", "f33", "ctrl+a", "Enter"])
def test_an_unknown_key_is_an_error(key: str) -> None:
    with pytest.raises(ProfileError, match="no key is named"):
        check_key(key)


def test_words_are_the_games_and_lead_to_pynputs() -> None:
    assert (WORDS["left.shift"], WORDS["escape"], WORDS["f20"], WORDS["space"]) == ("shift_l", "esc", "f20", "space")
