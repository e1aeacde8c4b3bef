"""The picture of the map: what it shows in which colour, and that it can be drawn before anything is known."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from matplotlib.colors import to_rgb

from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.report.arena_map import COLORS, SPENDING, draw_map
from tests.report.made_known_arena import made_known_arena


def area_of(path: Path, color: str) -> int:
    """Return how many pixels have exactly that colour."""
    picture = cv2.imread(str(path))
    assert picture is not None
    wanted = [round(255 * part) for part in reversed(to_rgb(color))]
    return int((picture == wanted).all(axis=2).sum())


def test_each_belief_is_drawn_with_the_area_of_its_cells(tmp_path: Path) -> None:
    draw_map(tmp_path / "map.png", "line", made_known_arena(episodes=0))
    believed = area_of(tmp_path / "map.png", COLORS[Belief.BELIEVED])
    unknown = area_of(tmp_path / "map.png", COLORS[Belief.UNKNOWN])
    assert believed > 5000
    assert unknown / believed == pytest.approx(12, rel=0.1)


def test_each_episode_has_a_bar_of_how_its_blocks_were_spent(tmp_path: Path) -> None:
    draw_map(tmp_path / "none.png", "line", made_known_arena(episodes=0))
    draw_map(tmp_path / "map.png", "line", made_known_arena(episodes=3))
    # Of each colour (1, 2, 3), (1, 1, 1), (1, 1, 1) and (1, 1, 1) blocks in three episodes.
    areas = [
        area_of(tmp_path / "map.png", color) - area_of(tmp_path / "none.png", color) for color, _ in SPENDING.values()
    ]
    assert np.array(areas) / areas[1] == pytest.approx([2, 1, 1, 1], rel=0.1)


@pytest.mark.parametrize("size", [4, 32])
def test_the_map_of_any_arena_has_the_same_picture_size(tmp_path: Path, size: int) -> None:
    draw_map(tmp_path / "map.png", "a $ in a name", made_known_arena(size, episodes=100))
    picture = cv2.imread(str(tmp_path / "map.png"))
    assert picture is not None
    assert picture.shape == (744, 1440, 3)
