"""The note of a copy: written before anything is built, removed once the profile knows the same."""

from pathlib import Path

import pytest

from calibration.arena.copy_note import (
    note_path,
    read_copy_note,
    remove_copy_note,
    remove_saved_copy_note,
    undo_command,
    undo_hint_on_error,
    write_copy_note,
)
from mc_nested.errors import LiveError, ProfileError
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import profile_path
from mc_nested.live.profile.tables import Profile

HERE = Profile(arena=Arena.around((7, 64, 0), "south").model_copy(update={"copied_to": (-8, 127, -1)}))
ELSEWHERE = Profile(arena=Arena.around((70, 64, 0), "south"))


def test_a_note_is_read_as_it_was_written_and_a_later_one_replaces_it(tmp_path: Path) -> None:
    file = tmp_path / "folder" / "mine.toml"
    assert read_copy_note(file) is None
    write_copy_note(ELSEWHERE, file)
    write_copy_note(HERE, file)
    assert read_copy_note(file) == HERE
    assert [each.name for each in file.parent.iterdir()] == ["mine.toml.ground"]


def test_a_note_that_can_not_be_written_or_removed_is_a_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(ProfileError, match="nothing was built"):
        write_copy_note(HERE, tmp_path / "file" / "mine.toml")
    note_path(tmp_path / "mine.toml").mkdir()
    with pytest.raises(ProfileError, match="remove it by hand"):
        remove_copy_note(tmp_path / "mine.toml")


def test_it_is_removed_once_the_saved_profile_has_the_same_arena(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    remove_saved_copy_note(HERE, file)
    write_copy_note(HERE, file)
    remove_saved_copy_note(ELSEWHERE, file)
    assert read_copy_note(file) == HERE
    remove_saved_copy_note(HERE, file)
    assert read_copy_note(file) is None
    remove_copy_note(file)


def test_the_command_names_the_profile_as_the_command_line_takes_it(tmp_path: Path) -> None:
    verb = "mc-nested calibrate arena --undo --profile"
    assert undo_command(profile_path("mine")) == f"{verb} mine"
    assert undo_command(profile_path("my game")) == f'{verb} "my game"'
    assert undo_command(tmp_path / "mine.toml") == f"{verb} {tmp_path / 'mine.toml'}"


def test_an_error_says_how_to_undo_only_where_there_is_something_to_undo(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    with pytest.raises(LiveError, match=r"^no$"), undo_hint_on_error(file):
        raise LiveError("no")
    write_copy_note(HERE, file)
    wanted = r"^no; what stood where the arena is comes back with mc-nested"
    with pytest.raises(LiveError, match=wanted), undo_hint_on_error(file):
        raise LiveError("no")
    with pytest.raises(KeyboardInterrupt), undo_hint_on_error(file):
        raise KeyboardInterrupt
