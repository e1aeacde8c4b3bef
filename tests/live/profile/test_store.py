"""Profiles: read with one-line errors, written without losing what a user wrote."""

from pathlib import Path

import platformdirs
import pytest
import tomlkit

from calibration.step_profile import starting_profile
from mc_nested.errors import ProfileError
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.store import (
    earlier_path,
    load_profile,
    parse_profile,
    save_profile,
    undo_profile,
)
from mc_nested.live.profile.tables import (
    BlocksTable,
    BodyTable,
    GameVersion,
    KeysTable,
    Profile,
    ScreenTable,
    WindowTable,
)

ARENA = Arena.around((5, 64, -20), "west")


def test_a_saved_profile_is_read_back_the_same(tmp_path: Path) -> None:
    profile = Profile(
        window=WindowTable(title="Web Client"),
        game=GameVersion(version="1.12.2"),
        keys=KeysTable(left="d", right="a"),
        screen=ScreenTable(font=str(tmp_path / "ascii.png"), debug_scale=3, line_pitch=10, text_colour=(255, 255, 255)),
        arena=ARENA,
        blocks=BlocksTable(shown_prefix="", names={"oak_planks": "planks"}),
        body=BodyTable(tolerance=0.12),
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
    assert "[walk] # How far a held key walks\n" in text
    assert "[points]" not in text


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


def test_saving_removes_keys_that_the_profile_no_longer_has(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(
        Profile(arena=ARENA, screen=ScreenTable(debug_scale=2), points={"a": (0.1, 0.1), "b": (0.2, 0.2)}), path
    )
    save_profile(Profile(points={"b": (0.3, 0.2)}), path)
    assert load_profile(path) == Profile(points={"b": (0.3, 0.2)})
    assert "arena" not in tomlkit.parse(path.read_text("utf-8"))


def test_saving_never_overwrites_a_file_that_is_not_toml(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[window\n", "utf-8")
    with pytest.raises(ProfileError, match="not TOML"):
        save_profile(Profile(), path)
    assert path.read_text("utf-8") == "[window\n"


def test_a_profile_that_can_not_be_written_leaves_no_file_behind(tmp_path: Path) -> None:
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


def test_saving_keeps_the_replaced_profile_in_a_file_beside_it(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    assert not earlier_path(path).exists()
    before = path.read_bytes()
    save_profile(Profile(arena=ARENA), path)
    assert earlier_path(path) == tmp_path / "mine.toml.before"
    assert earlier_path(path).read_bytes() == before


def test_saving_an_unchanged_profile_keeps_the_earlier_one(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    for profile in (Profile(), Profile(arena=ARENA), Profile(arena=ARENA)):
        save_profile(profile, path)
    assert parse_profile(earlier_path(path).read_text("utf-8"), "earlier") == Profile()


def test_saving_over_a_broken_file_keeps_the_earlier_profile(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    path.write_text("[windw]\ntitle = 'x'\n", "utf-8")
    save_profile(Profile(arena=ARENA), path)
    assert parse_profile(earlier_path(path).read_text("utf-8"), "earlier") == Profile()


def test_undo_restores_the_earlier_profile_and_a_second_undo_the_later_one(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(), path)
    save_profile(Profile(arena=ARENA), path)
    undo_profile(path)
    assert load_profile(path) == Profile()
    undo_profile(path)
    assert load_profile(path) == Profile(arena=ARENA)


def test_undo_restores_the_earlier_profile_over_a_broken_or_missing_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    for damage in (lambda: path.write_text("[window\n", "utf-8"), path.unlink):
        path.unlink(missing_ok=True)
        save_profile(Profile(), path)
        save_profile(Profile(arena=ARENA), path)
        damage()
        undo_profile(path)
        assert load_profile(path) == Profile()


@pytest.mark.parametrize("broken", [b"[walking]\nspeed = 4.3\n", b"[calibrated]\nformat = 99\n", b"# caf\xe9\n"])
def test_undo_keeps_an_unreadable_profile_under_a_new_name(tmp_path: Path, broken: bytes) -> None:
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


def test_undo_on_a_full_disk_loses_neither_profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_undo_changes_nothing_without_a_readable_earlier_profile(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    save_profile(Profile(arena=ARENA), path)
    with pytest.raises(ProfileError, match="no earlier profile"):
        undo_profile(path)
    earlier_path(path).write_text("[window\n", "utf-8")
    with pytest.raises(ProfileError, match="not TOML"):
        undo_profile(path)
    assert load_profile(path) == Profile(arena=ARENA)


@pytest.mark.parametrize("written", [0, 2])
def test_a_profile_of_another_format_is_an_error_that_says_so(written: int) -> None:
    text = f"[calibrated]\nformat = {written}\ndate = '2027-01-01'\n[walking]\nspeed = 4.3\n"
    with pytest.raises(ProfileError) as caught:
        parse_profile(text, "mine.toml")
    assert str(caught.value).startswith(f"mine.toml: a profile of format {written}, by another version")
    assert "mc-nested calibrate all --profile" in str(caught.value)


def test_a_profile_of_another_format_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[calibrated]\nformat = 2\ndate = '2027-01-01'\n", "utf-8")
    before = path.read_bytes()
    with pytest.raises(ProfileError, match="format 2"):
        starting_profile(path)
    assert path.read_bytes() == before


@pytest.mark.parametrize("name", ["", " ", "."])
def test_an_empty_profile_name_is_refused(name: str) -> None:
    with pytest.raises(ProfileError, match="names no profile: give a name"):
        load_profile(name)


def test_a_missing_profile_is_reported_with_the_command_that_makes_it(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="mc-nested calibrate all makes one"):
        load_profile(tmp_path / "none.toml")


def test_a_profile_name_is_looked_up_in_the_profile_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    save_profile(Profile(game=GameVersion(version="1.16.5")), profile_folder() / "laptop.toml")
    assert load_profile("laptop").game.version == "1.16.5"
    with pytest.raises(ProfileError, match=r"no profile 'lapdog'.*known are: laptop;.*calibrate all"):
        load_profile("lapdog")
