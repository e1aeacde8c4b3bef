import pytest

from sim.client.game.commands.words import (
    CommandRefusedError,
    after_player,
    block_name,
    block_position,
    coordinate,
    display_name,
)
from tests.sim.client.game.commands.commanded import realm


@pytest.mark.parametrize(
    ("word", "centred", "value"),
    [
        ("~", True, 3.25),
        ("~2", True, 5.25),
        ("~-0.5", True, 2.75),
        ("7", True, 7.5),
        ("-7", True, -6.5),
        ("7", False, 7.0),
        ("7.0", True, 7.0),
    ],
)
def test_a_coordinate_is_relative_or_in_the_middle_of_a_whole_block(word: str, centred: bool, value: float) -> None:
    assert coordinate(word, 3.25, centred=centred) == value


def test_three_words_name_a_block_absolutely_or_relative_to_the_players() -> None:
    assert block_position(realm(), ["~", "~-1", "~3"]) == (8, 63, 11)
    assert block_position(realm(), ["-1", "0", "7"]) == (-1, 0, 7)
    with pytest.raises(ValueError, match="argument"):
        block_position(realm(), ["1", "2"])


@pytest.mark.parametrize("word", ["@s", "@p", "@a", "Player"])
def test_after_player_returns_the_words_behind_the_players_name(word: str) -> None:
    assert after_player(realm(), [word, "a", "b"]) == ["a", "b"]


def test_a_command_for_another_player_is_refused() -> None:
    with pytest.raises(CommandRefusedError, match="No player was found"):
        after_player(realm(), ["Somebody", "a"])


@pytest.mark.parametrize(
    ("version", "known", "unknown"), [("1.12.2", "planks", "oak_planks"), ("1.13", "oak_planks", "planks")]
)
def test_blocks_have_the_names_of_the_version(version: str, known: str, unknown: str) -> None:
    assert block_name(realm(version), f"minecraft:{known}") == known
    assert block_name(realm(version), "stone") == "stone"
    with pytest.raises(CommandRefusedError, match=f"Unknown block type '{unknown}'"):
        block_name(realm(version), unknown)


def test_a_blocks_display_name_is_in_words() -> None:
    assert display_name("smooth_stone") == "Smooth Stone"
    assert display_name("planks") == "Oak Wood Planks"
