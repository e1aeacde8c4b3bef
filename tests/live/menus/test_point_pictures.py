"""The files of points' pictures: named, written as PNG, read again, and gone without harm."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.menus.point_pictures import load_click_points, picture_bytes, picture_file, pictures_folder
from mc_nested.live.profile.tables import Profile

PICTURE = np.random.default_rng(0).integers(0, 256, (20, 192, 3), np.uint8)


def test_a_picture_lies_in_a_folder_beside_the_profile() -> None:
    assert picture_file(Path("/x/mine.toml"), "singleplayer") == Path("/x/mine-points/singleplayer.png")
    assert picture_file(Path("/x/mine.toml"), "my point") == Path("/x/mine-points/my point.png")


@given(st.text(st.characters(codec="utf-8"), min_size=1, max_size=30))
def test_whatever_a_point_is_called_its_picture_is_one_file_in_that_folder(name: str) -> None:
    assert picture_file(Path("/x/mine.toml"), name).parent == pictures_folder(Path("/x/mine.toml"))


@given(st.text(st.characters(codec="utf-8"), min_size=1), st.text(st.characters(codec="utf-8"), min_size=1))
def test_two_names_are_two_files(one: str, other: str) -> None:
    assert (picture_file(Path("p.toml"), one) == picture_file(Path("p.toml"), other)) == (one == other)


def test_what_was_written_is_read_to_the_pixel(tmp_path: Path) -> None:
    profile, path = Profile(points={"world": (0.25, 0.5)}), tmp_path / "mine.toml"
    pictures_folder(path).mkdir()
    picture_file(path, "world").write_bytes(picture_bytes(PICTURE))
    (point,) = load_click_points(profile, path).values()
    np.testing.assert_array_equal(point.picture, PICTURE)
    assert (point.name, point.at) == ("world", (0.25, 0.5))


@pytest.mark.parametrize("content", [None, b"", b"no picture"])
def test_a_point_whose_picture_is_missing_or_broken_is_not_there_to_click(
    content: bytes | None, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    if content is not None:
        pictures_folder(path).mkdir()
        picture_file(path, "world").write_bytes(content)
    assert load_click_points(Profile(points={"world": (0.25, 0.5)}), path) == {}
