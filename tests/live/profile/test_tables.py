"""The tables of a profile: their limits, one line for a mistake, and what they say about versions and blocks."""

import re

import pytest
import tomlkit
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import ProfileError
from mc_nested.live.profile.store import parse_profile
from mc_nested.live.profile.tables import BlocksTable, GameVersion, Profile, WalkTable, WindowTable


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("[window]\ntitel = 'x'", "window.titel: unknown key: did you mean title?"),
        ("[arenas]", "arenas: unknown key: did you mean arena?"),
        ("[input]\nfoo = 1", "input.foo: unknown key: remove it; known are click_s, chat_open_s, chat_close_s"),
        ("[body]\ntolerance = '0.15'", "body.tolerance: Input should be a valid number, not '0.15': mend that key"),
        ("[body]\npitch = 90", "body.pitch: Input should be less than 72.8, not 90: mend that key"),
        ("[body]\npitch = nan", "body.pitch: Input should be a finite number"),
        ("window = 'Minecraft'", "window: must be a table: write [window] and its keys below"),
        ("[window]\ntitle = '('", "window.title: not a regular expression"),
        ("[game]\nversion = 'newest'", "game.version: String should match pattern"),
        ("[game]\nversion = '1.22'", "game.version: Minecraft has no version '1.22': write what its title screen says"),
        ("[screen]\nfont = 'ascii.png'", "screen.font: 'ascii.png' depends on where you are: write the whole path"),
        ("[keys]\nforward = 'up arrow'", "keys.forward: no key is named 'up arrow': write what a US keyboard types"),
        ("[keys]\nback = 'w'", "keys: 'w' is given for forward and for back: each needs a key of its own"),
        ("[keys]\nchat = 'f12'", "keys: 'f12' is given for chat and for panic"),
        (
            "[arena]\norigin = [1, 2, 3]\nfacing = 'south'\nmarked = [[1, 2, 3], [2, 3, 4]]\nfloor = 'a b'",
            "arena.floor",
        ),
        ("[keys]\nhotbar = ['1']", "keys.hotbar: Tuple should have at least 9 items"),
        ("[walk]\ncovered = [0.2, 0.4, 0.3, 0.8]", "walk.covered: must grow with every tick"),
        ("[points]\nRespawn = [0.5, 12]", "points.Respawn.1: Input should be less than or equal to 1, not 12"),
        ("[arena]\norigin = [1, 2, 3]\nfacing = 'south'", "arena.marked: missing: add it"),
        ("[arena]\norigin = [1, 2.5, 3]", "arena.origin.1: Input should be a valid integer, not 2.5"),
        ("[window", "not TOML"),
    ],
)
def test_a_mistake_in_a_profile_is_a_one_line_error_that_names_the_key(text: str, complaint: str) -> None:
    with pytest.raises(ProfileError) as caught:
        parse_profile(text, "mine.toml")
    assert str(caught.value).startswith(f"mine.toml: {complaint}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("title", "is_the_game"),
    [
        ("Minecraft 1.12.2", True),
        ("Minecraft* 1.20.1 - Singleplayer", True),
        ("Minecraft Launcher", False),
        ("How to play Minecraft 1.20 - Browser", False),
    ],
)
def test_the_default_title_matches_the_game_and_no_other_window(title: str, is_the_game: bool) -> None:
    assert bool(re.search(WindowTable().title, title)) is is_the_game


@pytest.mark.parametrize(
    ("version", "dialect"),
    [("1.8", "1.12"), ("1.12.2", "1.12"), ("1.13", "1.13"), ("1.16.5", "1.13"), ("1.17", "1.17"), ("26.1", "1.17")],
)
def test_each_version_has_its_dialect_of_commands(version: str, dialect: str) -> None:
    assert GameVersion(version=version).dialect == dialect


def test_planks_have_their_old_name_before_1_13_and_a_profile_may_rename_blocks() -> None:
    assert Profile(game=GameVersion(version="1.12.2")).shown_id("oak_planks") == "minecraft:planks"
    assert Profile(game=GameVersion(version="1.13")).shown_id("oak_planks") == "minecraft:oak_planks"
    assert Profile(blocks=BlocksTable(shown_prefix="", names={"stone": "rock"})).shown_id("stone") == "rock"


def test_a_missing_font_or_arena_says_what_to_do() -> None:
    with pytest.raises(ProfileError, match="write the path of your game's client jar"):
        Profile().screen.font_path()
    with pytest.raises(ProfileError, match="run mc-nested calibrate arena"):
        Profile().marked_arena()


@given(st.lists(st.floats(0.01, 0.5), min_size=4, max_size=20))
def test_any_growing_walk_response_is_read_back_from_toml(steps: list[float]) -> None:
    covered = tuple(sum(steps[: ticks + 1]) for ticks in range(len(steps)))
    profile = Profile(walk=WalkTable(covered=covered))
    assert parse_profile(tomlkit.dumps({"walk": {"covered": list(covered)}}), "mine.toml") == profile
