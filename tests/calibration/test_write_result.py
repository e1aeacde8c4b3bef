"""What a step found, written: pictures first, so that a profile never names a point without one."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from calibration.context import StepResult
from calibration.write_result import write_picture, write_result
from mc_nested.errors import ProfileError
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.menus.point_pictures import picture_file
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile

PICTURE = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)
POINT = ClickPoint("world", (0.5, 0.25), PICTURE)
FOUND = StepResult("clicks", Profile(points={"world": (0.5, 0.25)}), (), 1, points=(POINT,))


def test_the_profile_and_the_pictures_of_its_points_are_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    write_result(FOUND, file)
    assert load_profile(file) == FOUND.profile
    assert picture_file(file, "world").stat().st_mtime_ns <= file.stat().st_mtime_ns
    assert np.array_equal(np.asarray(cv2.imread(str(picture_file(file, "world")))), PICTURE)


def test_without_its_picture_a_point_is_not_written(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    picture_file(file, "world").parent.parent.mkdir(parents=True, exist_ok=True)
    picture_file(file, "world").mkdir(parents=True)
    with pytest.raises(ProfileError, match="the picture can't be written"):
        write_result(FOUND, file)
    assert not file.exists()


def test_a_picture_that_is_no_picture_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="can't be written"):
        write_picture(np.zeros((0, 0, 3), np.uint8), tmp_path / "empty.png")
    assert list(tmp_path.iterdir()) == []
