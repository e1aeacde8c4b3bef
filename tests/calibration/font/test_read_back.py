"""The debug screen is read back line by line on any background, and unknown glyphs are drawn in red."""

import numpy as np
import pytest

from calibration.font.read_back import ReadLine, phase_of, read_back, side_by_side
from mc_nested.live.vision.text_lines import UNKNOWN
from sim.client.client import VirtualClient
from tests.calibration.contexts import started
from tests.sim.client.playing import FONT


@pytest.mark.parametrize("world", ["bright", "dark", "noise", "grey noise", "specks"])
def test_both_columns_are_read_line_by_line(world: str) -> None:
    client = started(VirtualClient(world=world, pitch=65.0))
    lines = read_back(client.display.grab(), FONT)
    texts = [line.text for line in lines]
    assert texts[0].startswith("Minecraft 1.20.1")
    assert "XYZ: 0.500 / 64.00000 / 0.500" in texts
    assert "Facing: south (Towards positive Z) (0.0 / 65.0)" in texts
    assert texts[-1] == "minecraft:bedrock"
    assert all(line.is_known for line in lines)
    assert len(set(texts)) == len(texts)


def test_without_a_debug_screen_there_is_nothing_to_read() -> None:
    client = started(VirtualClient(has_f3=False))
    frame = client.display.grab()
    assert read_back(frame, FONT) == []
    assert phase_of(frame, FONT) is None


@pytest.mark.parametrize("shift", [(0, 0), (1, 0), (0, 1), (1, 1)])
def test_phase_is_the_shift_of_the_picture_in_pixels(shift: tuple[int, int]) -> None:
    frame = started(VirtualClient(scale=3, size=(1280, 720))).display.grab()
    assert phase_of(np.roll(frame, shift, (1, 0)), FONT) == shift


def test_pictures_stand_on_the_left_and_texts_on_the_right() -> None:
    picture = np.full((18, 100, 3), (0, 200, 0), np.uint8)
    drawn = side_by_side([ReadLine("known", picture), ReadLine(f"kn{UNKNOWN}wn", picture)])
    green, red = (drawn == (0, 200, 0)).all(2), (drawn == (80, 80, 255)).all(2)
    middle = int(np.argwhere(green)[:, 1].max()) + 1
    # Two pictures of 18 rows, each drawn twice as large.
    assert green.sum() == 2 * (2 * 18) * (2 * 100)
    assert not red[: drawn.shape[0] // 2].any()
    assert red[drawn.shape[0] // 2 :, middle:].any()


def test_no_lines_make_an_empty_drawing() -> None:
    assert side_by_side([]).ndim == 3
