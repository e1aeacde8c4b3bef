"""The entries that are on: debug-profile.json of each version (FACTS: debug-profile.json)."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import UserError
from sim.client.game.debug_entries import (
    GAME_DEFAULT,
    PERFORMANCE,
    TUTORIAL,
    DebugEntries,
    known_entries,
    read_profile,
    shown_entries,
)
from sim.client.game.edition import Edition

OLD, MIDDLE, NEW = Edition("1.21.9"), Edition("1.21.11"), Edition("26.1")


def parse_profile(text: str | None, edition: Edition) -> DebugEntries:
    """Return the entries that a debug-profile.json stands for; ``text`` is None if there is no such file.

    As in the game, one that can't be read counts as the default, and ``custom`` replaces everything.
    """
    try:
        return GAME_DEFAULT if text is None else read_profile(text, edition)
    except UserError:
        return GAME_DEFAULT


def custom(status: str, version: int | None = None, entry: str = "minecraft:fps") -> str:
    profile: dict[str, object] = {"custom": {entry: status}}
    return json.dumps(profile if version is None else {"DataVersion": version, **profile})


def test_the_default_entries_do_not_show_the_target_block() -> None:
    for edition in (OLD, NEW, Edition("26.4")):
        shown = shown_entries(GAME_DEFAULT, edition, has_f3=True)
        assert not [entry for entry in shown if entry.startswith("looking")]
        assert list(shown) == sorted(shown)
    assert shown_entries(GAME_DEFAULT, OLD, has_f3=False) == ()


@pytest.mark.parametrize(
    ("version", "entry"),
    [("1.21.11", "looking_at_block"), ("26.1", "looking_at_block_state"), ("26.4", "looking_at_block_state")],
)
def test_the_tutorials_entries_name_the_block_in_each_versions_word(version: str, entry: str) -> None:
    shown = shown_entries(TUTORIAL, Edition(version), has_f3=True)
    assert [name for name in shown if name.startswith("looking")] == [entry]


def test_a_version_without_entries_shows_none() -> None:
    assert known_entries(Edition("1.21.8")) == ()
    assert shown_entries(TUTORIAL, Edition("1.21.8"), has_f3=True) == ()


@pytest.mark.parametrize(("version", "entry"), [("26.1", "post_effect"), ("26.3", "post_effects")])
def test_each_version_knows_an_entry_under_its_own_name(version: str, entry: str) -> None:
    known = known_entries(Edition(version))
    assert entry in known
    assert len({"post_effect", "post_effects"} & set(known)) == 1


def test_reduced_debug_info_hides_the_position_and_the_target_block() -> None:
    shown = shown_entries(TUTORIAL, NEW, has_f3=True, is_reduced=True)
    assert "player_section_position" in shown
    assert not {"player_position", "looking_at_block_state"} & set(shown)
    two = {"player_position": "alwaysOn", "looking_at_block": "alwaysOn"}
    assert shown_entries(two, OLD, has_f3=True, is_reduced=True) == ()  # type: ignore[arg-type]  # plain texts


def test_only_entries_that_are_always_on_are_shown_without_f3() -> None:
    assert shown_entries(PERFORMANCE, NEW, has_f3=False) == ("fps",)
    assert "player_position" not in shown_entries(PERFORMANCE, NEW, has_f3=True)


def test_a_debug_profile_replaces_all_entries_and_a_missing_one_leaves_the_defaults() -> None:
    assert parse_profile(None, OLD) is GAME_DEFAULT
    assert parse_profile('{"profile":"default"}', OLD) is GAME_DEFAULT
    assert parse_profile('{"profile":"performance"}', OLD) is PERFORMANCE
    assert parse_profile(custom("alwaysOn"), OLD) == {"fps": "alwaysOn"}
    assert parse_profile("{}", OLD) == {}


@pytest.mark.parametrize(
    ("text", "edition", "expected"),
    [
        (custom("inF3"), OLD, {"fps": "inOverlay"}),
        (custom("inOverlay"), OLD, GAME_DEFAULT),
        (custom("inOverlay", 4671), MIDDLE, {"fps": "inOverlay"}),
        (custom("inF3", 4671), MIDDLE, GAME_DEFAULT),
        (custom("inF3", 4649), MIDDLE, {"fps": "inOverlay"}),
        (custom("inF3"), MIDDLE, {"fps": "inOverlay"}),
        ('{"DataVersion":"x","custom":{"minecraft:fps":"inF3"}}', MIDDLE, {"fps": "inOverlay"}),
    ],
)
def test_the_word_for_entries_shown_with_f3_depends_on_the_version(
    text: str, edition: Edition, expected: object
) -> None:
    assert parse_profile(text, edition) == expected


@pytest.mark.parametrize(
    ("version", "entry"),
    [(4649, "looking_at_block_state"), (4671, "looking_at_block_state"), (4790, "looking_at_block")],
)
def test_an_older_files_ids_are_upgraded(version: int, entry: str) -> None:
    assert parse_profile(custom("alwaysOn", version, "minecraft:looking_at_block"), NEW) == {entry: "alwaysOn"}
    assert parse_profile(custom("alwaysOn", version, "minecraft:looking_at_block"), MIDDLE) == {
        "looking_at_block": "alwaysOn"
    }


def test_an_unknown_id_is_ignored() -> None:
    text = '{"custom":{"minecraft:nothing":"alwaysOn","mod:fps":"alwaysOn","tps":"alwaysOn"}}'
    assert shown_entries(parse_profile(text, OLD), OLD, has_f3=True) == ("tps",)


@pytest.mark.parametrize(
    "text",
    [
        *("", "{", "[]", "1", "null", '"default"', '{"profile":"fast"}', '{"profile":1}', '{"custom":[]}'),
        *('{"custom":1}', custom("sometimes"), '{"custom":{"minecraft:fps":true}}'),
        *(custom("never", entry="Minecraft:FPS"), "[" * 9_999),
    ],
)
def test_a_file_that_cannot_be_read_counts_as_the_default(text: str) -> None:
    for edition in (OLD, MIDDLE, NEW):
        assert parse_profile(text, edition) is GAME_DEFAULT


@given(st.text() | st.recursive(st.none() | st.booleans() | st.text(), st.lists).map(json.dumps))
def test_any_text_of_a_debug_profile_leads_to_shown_entries(text: str) -> None:
    assert shown_entries(parse_profile(text, NEW), NEW, has_f3=True) is not None
