"""Undoing an arena: the verb, the note of a copy, and the hint in an error.

The note of a copy: written before anything is built, removed once the profile knows the same.
"""

from contextlib import AbstractContextManager
from pathlib import Path

import pytest

from calibration.arena.build import build_arena
from calibration.arena.undo import (
    note_path,
    read_copy_note,
    remove_copy_note,
    remove_saved_copy_note,
    undo_arena,
    undo_built_arena,
    undo_command,
    undo_hint_on_error,
    write_copy_note,
)
from calibration.context import CalibrationContext
from mc_nested.errors import DesktopError, LiveError, ProfileError, UserError
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile, profile_path, save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_on, profile_of

HERE = Arena.around((7, 64, 0), "south")
COPIED = HERE.model_copy(update={"copied_to": (-8, 127, -1)})


def no_window(_profile: Profile) -> AbstractContextManager[CalibrationContext]:
    raise DesktopError("a window was looked for")


@pytest.mark.parametrize(
    ("profile", "error", "message"),
    [
        (Profile(), ProfileError, "arena"),
        (Profile(arena=HERE), UserError, "no copy is known"),
        (Profile(arena=COPIED), DesktopError, "a window was looked for"),
    ],
)
def test_undo_looks_for_a_window_only_if_the_profile_has_a_copy(
    profile: Profile, error: type[Exception], message: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile, file)
    with pytest.raises(error, match=message):
        undo_built_arena(file, no_window)
    assert load_profile(file) == profile


def test_undo_without_a_profile_or_a_note_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ProfileError):
        undo_built_arena(tmp_path / "mine.toml", no_window)


def test_undo_puts_the_blocks_back_and_removes_the_arena_from_the_profile_and_the_note(tmp_path: Path) -> None:
    client, file = VirtualClient(), tmp_path / "mine.toml"
    client.realm.world.put((3, 64, 6), "stone")
    before = client.built
    profile = profile_of(client, tmp_path)
    with context_on(client)(profile) as context:
        built = build_arena(context, profile).profile
    assert client.built != before
    save_profile(built, file)
    write_copy_note(built, file)
    result, path = undo_built_arena(file, context_on(client))
    assert client.built == before
    assert path == file
    assert (result.step, result.samples) == ("arena", 1)
    assert "put back from (-8, 127, -1)" in result.lines[0]
    assert load_profile(file) == built.model_copy(update={"arena": None})
    assert not note_path(file).exists()


def test_undo_step_refuses_a_profile_without_a_copy(tmp_path: Path) -> None:
    client = VirtualClient()
    profile = profile_of(client, tmp_path).model_copy(update={"arena": HERE})
    with context_on(client)(profile) as context, pytest.raises(UserError, match="no copy is known"):
        undo_arena(context, profile)


PROFILE_HERE = Profile(arena=Arena.around((7, 64, 0), "south").model_copy(update={"copied_to": (-8, 127, -1)}))
PROFILE_ELSEWHERE = Profile(arena=Arena.around((70, 64, 0), "south"))


def test_a_note_is_read_as_it_was_written_and_a_later_one_replaces_it(tmp_path: Path) -> None:
    file = tmp_path / "folder" / "mine.toml"
    assert read_copy_note(file) is None
    write_copy_note(PROFILE_ELSEWHERE, file)
    write_copy_note(PROFILE_HERE, file)
    assert read_copy_note(file) == PROFILE_HERE
    assert [each.name for each in file.parent.iterdir()] == ["mine.toml.ground"]


def test_a_note_that_can_not_be_written_or_removed_is_a_one_line_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(ProfileError, match="nothing was built"):
        write_copy_note(PROFILE_HERE, tmp_path / "file" / "mine.toml")
    note_path(tmp_path / "mine.toml").mkdir()
    with pytest.raises(ProfileError, match="remove it by hand"):
        remove_copy_note(tmp_path / "mine.toml")


def test_a_note_is_removed_once_the_saved_profile_has_the_same_arena(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    remove_saved_copy_note(PROFILE_HERE, file)
    write_copy_note(PROFILE_HERE, file)
    remove_saved_copy_note(PROFILE_ELSEWHERE, file)
    assert read_copy_note(file) == PROFILE_HERE
    remove_saved_copy_note(PROFILE_HERE, file)
    assert read_copy_note(file) is None
    remove_copy_note(file)


def test_undo_command_names_the_profile_by_name_or_path_and_quotes_spaces(tmp_path: Path) -> None:
    verb = "mc-nested calibrate arena --undo --profile"
    assert undo_command(profile_path("mine")) == f"{verb} mine"
    assert undo_command(profile_path("my game")) == f'{verb} "my game"'
    assert undo_command(tmp_path / "mine.toml") == f"{verb} {tmp_path / 'mine.toml'}"


def test_an_error_says_how_to_undo_only_where_there_is_something_to_undo(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    with pytest.raises(LiveError, match=r"^no$"), undo_hint_on_error(file):
        raise LiveError("no")
    write_copy_note(PROFILE_HERE, file)
    wanted = r"^no; what stood where the arena is comes back with mc-nested"
    with pytest.raises(LiveError, match=wanted), undo_hint_on_error(file):
        raise LiveError("no")
    with pytest.raises(KeyboardInterrupt), undo_hint_on_error(file):
        raise KeyboardInterrupt
