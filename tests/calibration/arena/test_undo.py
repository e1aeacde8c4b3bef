"""Undoing an arena, as the verb does it: what has to be known before a window is opened."""

from contextlib import AbstractContextManager
from pathlib import Path

import pytest

from calibration.arena.build import build_arena
from calibration.arena.copy_note import note_path, write_copy_note
from calibration.arena.undo import undo_arena, undo_built_arena
from calibration.context import CalibrationContext
from mc_nested.errors import DesktopError, ProfileError, UserError
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.calibration.virtual_context import context_on, profile_of

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
def test_a_window_is_opened_only_with_a_copy_to_put_back(
    profile: Profile, error: type[Exception], message: str, tmp_path: Path
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile, file)
    with pytest.raises(error, match=message):
        undo_built_arena(file, no_window)
    assert load_profile(file) == profile


def test_without_profile_and_note_there_is_nothing_to_undo(tmp_path: Path) -> None:
    with pytest.raises(ProfileError):
        undo_built_arena(tmp_path / "mine.toml", no_window)


def test_what_stood_there_is_back_and_profile_and_note_forget_the_arena(tmp_path: Path) -> None:
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


def test_a_profile_without_a_copy_is_refused_by_the_step_too(tmp_path: Path) -> None:
    client = VirtualClient()
    profile = profile_of(client, tmp_path).model_copy(update={"arena": HERE})
    with context_on(client)(profile) as context, pytest.raises(UserError, match="no copy is known"):
        undo_arena(context, profile)
