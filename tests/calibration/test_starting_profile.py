"""What a calibration starts from, and files that no profile can be written to."""

from pathlib import Path

import pytest

from calibration.starting_profile import check_writable, starting_profile
from mc_nested.errors import ProfileError
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import KeysTable, Profile

SWAPPED = Profile(keys=KeysTable(left="d", right="a"))


def test_a_profile_that_is_there_is_read_and_else_a_new_one_is_begun(tmp_path: Path) -> None:
    file = tmp_path / "folder" / "mine.toml"
    assert starting_profile(file) == (file, Profile())
    assert list((tmp_path / "folder").iterdir()) == []
    save_profile(SWAPPED, file)
    assert starting_profile(str(file)) == (file, SWAPPED)


def test_a_folder_or_a_file_in_the_way_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "dir.toml").mkdir()
    with pytest.raises(ProfileError, match="is a folder"):
        check_writable(tmp_path / "dir.toml")
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(ProfileError, match="can't be written"):
        check_writable(tmp_path / "file" / "mine.toml")
