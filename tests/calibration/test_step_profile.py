"""The profile that a calibration starts from, and refusals of files that can't be written.

What a step found, written: pictures first, so that a profile never names a point without one.
"""

from pathlib import Path

import cv2
import numpy as np
import pytest

from calibration.context import StepResult
from calibration.step_profile import check_writable, starting_profile, write_picture, write_result
from mc_nested.errors import ProfileError
from mc_nested.live.menus.click_points import ClickPoint, picture_file
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import KeysTable, Profile

SWAPPED = Profile(keys=KeysTable(left="d", right="a"))


def test_starting_profile_is_the_saved_one_or_a_new_one(tmp_path: Path) -> None:
    file = tmp_path / "folder" / "mine.toml"
    assert starting_profile(file) == (file, Profile())
    assert list((tmp_path / "folder").iterdir()) == []
    save_profile(SWAPPED, file)
    assert starting_profile(str(file)) == (file, SWAPPED)


def test_a_folder_or_a_file_in_the_way_is_a_one_line_error(tmp_path: Path) -> None:
    (tmp_path / "dir.toml").mkdir()
    with pytest.raises(ProfileError, match="is a folder"):
        check_writable(tmp_path / "dir.toml")
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(ProfileError, match="can't be written"):
        check_writable(tmp_path / "file" / "mine.toml")


PICTURE = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)
POINT = ClickPoint("world", (0.5, 0.25), PICTURE)
FOUND = StepResult("clicks", Profile(points={"world": (0.5, 0.25)}), (), 1, points=(POINT,))


def test_the_profile_and_the_pictures_of_its_points_are_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    write_result(FOUND, file)
    assert load_profile(file) == FOUND.profile
    assert picture_file(file, "world").stat().st_mtime_ns <= file.stat().st_mtime_ns
    assert np.array_equal(np.asarray(cv2.imread(str(picture_file(file, "world")))), PICTURE)


def test_profile_is_not_written_if_a_points_picture_cannot_be(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    picture_file(file, "world").parent.parent.mkdir(parents=True, exist_ok=True)
    picture_file(file, "world").mkdir(parents=True)
    with pytest.raises(ProfileError, match="the picture can't be written"):
        write_result(FOUND, file)
    assert not file.exists()


def test_an_empty_picture_is_a_one_line_error(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="can't be written"):
        write_picture(np.zeros((0, 0, 3), np.uint8), tmp_path / "empty.png")
    assert list(tmp_path.iterdir()) == []
