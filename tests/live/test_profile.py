"""Profiles: read with one-line errors, written without losing what a user wrote."""

from pathlib import Path

import platformdirs
import pytest
import tomlkit
from hypothesis import given
from hypothesis import strategies as st

from calibration.start import profile_to_calibrate
from mc_nested.errors import ProfileError
from mc_nested.live.profile import (
    Profile,
    earlier_path,
    load_profile,
    parse_profile,
    profile_folder,
    save_profile,
    undo_profile,
)
from mc_nested.live.profile_tables import Arena, Blocks, Body, GameVersion, Keys, Screen, Walk, Window

ARENA = Arena.around((5, 64, -20), "west")


def test_a_saved_profile_is_read_back_the_same(tmp_path: Path) -> None:
    profile = Profile(
        window=Window(title="Web Client"),
        game=GameVersion(version="1.12.2"),
        keys=Keys(left="d", right="a"),
        screen=Screen(font=str(tmp_path / "ascii.png"), gui_scale=3, line_pitch=10, text_colour=(255, 255, 255)),
        arena=ARENA,
        blocks=Blocks(shown_prefix="", names={"oak_planks": "planks"}),
        body=Body(tolerance=0.12),
        points={"Respawn": (0.5, 0.25)},
    )
    save_profile(profile, tmp_path / "new folder" / "mine.toml")
    assert load_profile(tmp_path / "new folder" / "mine.toml") == profile


def test_an_empty_file_is_the_default_profile() -> None:
    assert parse_profile("", "empty.toml") == Profile()


def test_a_new_file_explains_its_keys(tmp_path: Path) -> None:
    save_profile(Profile(), tmp_path / "new.toml")
    text = (tmp_path / "new.toml").read_text("utf-8")
    assert "# length of a click; at 0.2 s the game would place a second block\nclick_s = 0.08\n" in text
    assert "# font: the game's own client jar" in text


def test_saving_keeps_a_users_comments_and_order(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        "# my laptop\n[body] # slow\ntolerance = 0.12 # measured twice\n\n[window]\ntitle = 'Minecraft' # mine\n",
        "utf-8",
    )
    save_profile(load_profile(path).model_copy(update={"arena": ARENA}), path)
    text = path.read_text("utf-8")
    assert text.startswith("# my laptop\n[body] # slow\ntolerance = 0.12 # measured twice\n")
    assert "title = 'Minecraft' # mine\n" in text
    assert load_profile(path).arena == ARENA


def test_saving_twice_changes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(arena=ARENA, points={"Respawn": (0.5, 0.25)}), path)
    first = path.read_text("utf-8")
    save_profile(load_profile(path), path)
    assert path.read_text("utf-8") == first


def test_what_a_profile_no_longer_says_leaves_the_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(arena=ARENA, screen=Screen(gui_scale=2), points={"a": (0.1, 0.1), "b": (0.2, 0.2)}), path)
    save_profile(Profile(points={"b": (0.3, 0.2)}), path)
    assert load_profile(path) == Profile(points={"b": (0.3, 0.2)})
    assert "arena" not in tomlkit.parse(path.read_text("utf-8"))


def test_a_file_that_is_no_toml_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[window\n", "utf-8")
    with pytest.raises(ProfileError, match="not TOML"):
        save_profile(Profile(), path)
    assert path.read_text("utf-8") == "[window\n"


def test_a_profile_that_can_not_be_written_leaves_nothing_behind(tmp_path: Path) -> None:
    folder = tmp_path / "mine.toml"
    folder.mkdir()
    with pytest.raises(ProfileError, match="can't be"):
        save_profile(Profile(), folder)
    assert list(tmp_path.iterdir()) == [folder]


def test_a_write_that_breaks_off_leaves_the_old_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    before = path.read_text("utf-8")

    def break_off(_self: Path, _target: Path) -> Path:
        raise OSError("the disk is full")

    monkeypatch.setattr(Path, "replace", break_off)
    with pytest.raises(ProfileError, match=r"can't be written \(the disk is full\)"):
        save_profile(Profile(arena=ARENA), path)
    assert path.read_text("utf-8") == before
    assert list(tmp_path.iterdir()) == [path]


def test_the_profile_that_another_one_replaces_stays_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    assert not earlier_path(path).exists()
    before = path.read_bytes()
    save_profile(Profile(arena=ARENA), path)
    assert earlier_path(path) == tmp_path / "mine.toml.before"
    assert earlier_path(path).read_bytes() == before


def test_saving_the_same_again_keeps_the_earlier_one(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    for profile in (Profile(), Profile(arena=ARENA), Profile(arena=ARENA)):
        save_profile(profile, path)
    assert parse_profile(earlier_path(path).read_text("utf-8"), "earlier") == Profile()


def test_a_file_that_was_no_profile_takes_no_earlier_ones_place(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    path.write_text("[windw]\ntitle = 'x'\n", "utf-8")
    save_profile(Profile(arena=ARENA), path)
    assert parse_profile(earlier_path(path).read_text("utf-8"), "earlier") == Profile()


def test_undone_the_earlier_profile_is_back_and_undone_again_the_later_one(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    undo_profile(path)
    assert load_profile(path) == Profile()
    undo_profile(path)
    assert load_profile(path) == Profile(arena=ARENA)


def test_undoing_brings_the_last_good_profile_back_whatever_became_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    for spoil in (lambda: path.write_text("[window\n", "utf-8"), path.unlink):
        path.unlink(missing_ok=True)
        save_profile(Profile(), path)
        save_profile(Profile(arena=ARENA), path)
        spoil()
        undo_profile(path)
        assert load_profile(path) == Profile()


@pytest.mark.parametrize("broken", [b"[walking]\nspeed = 4.3\n", b"[calibrated]\nformat = 99\n", b"# caf\xe9\n"])
def test_what_is_undone_and_can_not_be_read_is_kept_and_overwrites_nothing(tmp_path: Path, broken: bytes) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    for name in ("mine.toml.broken", "mine.toml.broken1"):
        path.write_bytes(broken + name.encode())
        assert undo_profile(path) == tmp_path / name
        assert load_profile(path) == Profile()
    for name in ("mine.toml.broken", "mine.toml.broken1"):
        assert (tmp_path / name).read_bytes() == broken + name.encode()
    assert earlier_path(path).read_bytes() == path.read_bytes()


def test_an_undoing_that_finds_no_room_loses_neither_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    one, other = path.read_bytes(), earlier_path(path).read_bytes()

    def full(_handle: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(ProfileError, match="make room"):
        undo_profile(path)
    assert (path.read_bytes(), earlier_path(path).read_bytes()) == (one, other)


def test_without_a_good_earlier_profile_nothing_is_undone(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(arena=ARENA), path)
    with pytest.raises(ProfileError, match="no earlier profile"):
        undo_profile(path)
    earlier_path(path).write_text("[window\n", "utf-8")
    with pytest.raises(ProfileError, match="not TOML"):
        undo_profile(path)
    assert load_profile(path) == Profile(arena=ARENA)


@pytest.mark.parametrize(("written", "remedy"), [(2, "by newer mc-nested"), (0, "by older mc-nested")])
def test_a_profile_of_another_format_is_one_line_that_says_so(written: int, remedy: str) -> None:
    text = f"[calibrated]\nformat = {written}\ndate = '2027-01-01'\n[walking]\nspeed = 4.3\n"
    with pytest.raises(ProfileError) as caught:
        parse_profile(text, "mine.toml")
    assert str(caught.value).startswith(f"mine.toml: a profile of format {written}, {remedy}")
    assert "mc-nested calibrate all --profile" in str(caught.value)


def test_a_profile_of_another_format_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[calibrated]\nformat = 2\ndate = '2027-01-01'\n", "utf-8")
    before = path.read_bytes()
    with pytest.raises(ProfileError, match="format 2"):
        profile_to_calibrate(path)
    assert path.read_bytes() == before


@pytest.mark.parametrize("name", ["", " ", "."])
def test_no_name_is_no_profile(name: str) -> None:
    with pytest.raises(ProfileError, match="names no profile: give a name"):
        load_profile(name)


def test_a_profile_that_is_not_there_is_told_what_makes_it(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="mc-nested calibrate all makes one"):
        load_profile(tmp_path / "none.toml")


def test_a_name_means_a_file_in_the_profile_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    save_profile(Profile(game=GameVersion(version="1.16.5")), profile_folder() / "laptop.toml")
    assert load_profile("laptop").game.version == "1.16.5"
    with pytest.raises(ProfileError, match=r"no profile 'lapdog'.*known are: laptop;.*calibrate all"):
        load_profile("lapdog")


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
        ("[screen]\nfont = 'ascii.png'", "screen.font: 'ascii.png' depends on where you are: write the whole path"),
        ("[keys]\nforward = 'up arrow'", "keys.forward: no key is named 'up arrow': write one character"),
        ("[keys]\nhotbar = ['1']", "keys.hotbar: Tuple should have at least 9 items"),
        ("[walk]\ncovered = [0.2, 0.4, 0.3, 0.8]", "walk.covered: must grow with every tick"),
        ("[points]\nRespawn = [0.5, 12]", "points.Respawn.1: Input should be less than or equal to 1, not 12"),
        ("[arena]\norigin = [1, 2, 3]\nfacing = 'south'", "arena.marked: missing: add it"),
        ("[arena]\norigin = [1, 2.5, 3]", "arena.origin.1: Input should be a valid integer, not 2.5"),
        ("[window", "not TOML"),
    ],
)
def test_a_mistake_is_one_line_that_names_the_key(text: str, complaint: str) -> None:
    with pytest.raises(ProfileError) as caught:
        parse_profile(text, "mine.toml")
    assert str(caught.value).startswith(f"mine.toml: {complaint}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("marked", "complaint"),
    [
        ("[[0, 64, 0], [13, 65, 14]]", "don't hold the whole arena"),
        ("[[0, 63, 0], [-14, 65, 14]]", "into the floor"),
        ("[[0, 64, 0], [-200, 264, 200]]", "more than 32768 blocks"),
    ],
)
def test_a_reset_is_never_let_outside_the_marked_blocks(marked: str, complaint: str) -> None:
    with pytest.raises(ProfileError, match=complaint):
        parse_profile(f"[arena]\norigin = [0, 64, 0]\nfacing = 'south'\nmarked = {marked}", "mine.toml")


@pytest.mark.parametrize(
    ("title", "is_the_game"),
    [
        ("Minecraft 1.12.2", True),
        ("Minecraft* 1.20.1 - Singleplayer", True),
        ("Minecraft Launcher", False),
        ("How to play Minecraft 1.20 - Browser", False),
    ],
)
def test_the_default_title_is_the_games_and_no_other_windows(title: str, is_the_game: bool) -> None:
    assert Window().matches(title) is is_the_game


@pytest.mark.parametrize(
    ("version", "dialect"),
    [("1.8", "1.12"), ("1.12.2", "1.12"), ("1.13", "1.13"), ("1.16.5", "1.13"), ("1.17", "1.17"), ("26.1", "1.17")],
)
def test_every_version_has_its_dialect(version: str, dialect: str) -> None:
    assert GameVersion(version=version).dialect == dialect


def test_planks_have_their_old_name_in_an_old_game() -> None:
    assert Profile(game=GameVersion(version="1.12.2")).shown_id("oak_planks") == "minecraft:planks"
    assert Profile(game=GameVersion(version="1.13")).shown_id("oak_planks") == "minecraft:oak_planks"
    assert Profile(blocks=Blocks(shown_prefix="", names={"stone": "rock"})).shown_id("stone") == "rock"


def test_a_missing_font_or_arena_says_what_to_do() -> None:
    with pytest.raises(ProfileError, match="write the path of your game's client jar"):
        Profile().screen.font_path()
    with pytest.raises(ProfileError, match="run mc-nested calibrate arena"):
        Profile().marked_arena()


@given(st.lists(st.floats(0.01, 0.5), min_size=4, max_size=20))
def test_any_growing_walk_survives_the_file(steps: list[float]) -> None:
    covered = tuple(sum(steps[: ticks + 1]) for ticks in range(len(steps)))
    profile = Profile(walk=Walk(covered=covered))
    assert parse_profile(tomlkit.dumps({"walk": {"covered": list(covered)}}), "mine.toml") == profile
