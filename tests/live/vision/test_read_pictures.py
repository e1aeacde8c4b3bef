"""Drives read_picture with files; what is read from a frame is left to test_debug_screen.py.

Whether a picture is of the game's window alone: its debug screen fills the width from the upper left corner on.
"""

import re
import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.errors import PictureError
from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.read_pictures import PictureReading, read_picture, shows_more_than_window
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS

FONT = font_of(drawn_atlas())
SCREEN = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, 65.0, Target((8, 63, -2), "minecraft:stone"))


def picture(path: Path, screen: F3Screen = SCREEN) -> Path:
    cv2.imwrite(str(path), paint(np.full((480, 854, 3), 60, np.uint8), screen, FONT))
    return path


@pytest.mark.parametrize("overlay", [None, Overlay(2, VANILLA, (224, 224, 224))], ids=["found", "given"])
def test_read_picture_returns_the_reading_of_a_picture_file(tmp_path: Path, overlay: Overlay | None) -> None:
    path = picture(tmp_path / "größe.png".replace("ö", "o").replace("ß", "ss"))
    target = Target((8, 63, -2), "minecraft:stone")
    assert read_picture(path, FONT, overlay) == PictureReading(path, (8.5, 64.0, -3.25), 0.0, 65.0, target, None)


def test_a_picture_without_a_target_block_has_target_none(tmp_path: Path) -> None:
    screen = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, -65.0)
    assert read_picture(picture(tmp_path / "sky.png", screen), FONT, None).target is None


@pytest.mark.parametrize(
    "data", [None, b"", b"no picture", b"\x89PNG\r\n\x1a\n"], ids=["missing", "empty", "text", "cut"]
)
def test_a_file_that_is_not_a_picture_is_an_error(tmp_path: Path, data: bytes | None) -> None:
    path = tmp_path / "given.png"
    if data is not None:
        path.write_bytes(data)
    with pytest.raises(PictureError, match=f"{re.escape(str(path))} (is not a picture|can't be read)"):
        read_picture(path, FONT, None)


def test_reading_a_folder_as_a_picture_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(PictureError, match="can't be read"):
        read_picture(tmp_path, FONT, None)


def test_a_grey_picture_of_sixteen_bits_reads_as_unreadable(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "deep.png"), np.zeros((300, 400), np.uint16))
    assert read_picture(tmp_path / "deep.png", FONT, None).xyz is None


def test_a_picture_with_too_many_pixels_to_open_is_an_error(tmp_path: Path) -> None:
    header = b"IHDR" + struct.pack(">IIBBBBB", 60_000, 60_000, 8, 2, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + header + struct.pack(">I", zlib.crc32(header))
    (tmp_path / "huge.png").write_bytes(data)
    with pytest.raises(PictureError, match="is not a picture, or is damaged"):
        read_picture(tmp_path / "huge.png", FONT, None)


def test_a_png_without_a_debug_screen_is_not_called_a_jpeg(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "world.png"), np.full((480, 854, 3), 60, np.uint8))
    problem = str(read_picture(tmp_path / "world.png", FONT, None).problem)
    assert problem.startswith("no debug screen is to be seen at a GUI scale from 1 to 8")


@pytest.mark.parametrize(("left", "top"), [(100, 62), (0, 0)])
def test_a_picture_with_the_desktop_around_the_window_says_to_cut_it_off(left: int, top: int, tmp_path: Path) -> None:
    screen = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, -65.0)
    desktop = np.full((top + 480 + 100, left + 854 + 300, 3), 90, np.uint8)
    desktop[top : top + 480, left : left + 854] = paint(np.full((480, 854, 3), 60, np.uint8), screen, FONT)
    cv2.imwrite(str(tmp_path / "desktop.png"), desktop)
    assert read_picture(tmp_path / "desktop.png", FONT).problem == (
        "the picture shows more than the game's window: cut off the window's frame and the desktop, or take it with F2"
    )


def test_the_problem_without_a_debug_screen_says_to_picture_the_window_alone(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "world.png"), np.full((480, 854, 3), 60, np.uint8))
    assert str(read_picture(tmp_path / "world.png", FONT).problem).endswith(
        "; and the picture has to be of the game's window alone, as F2 takes it"
    )


def test_the_problem_of_an_unreadable_jpeg_names_the_jpeg(tmp_path: Path) -> None:
    assert "a JPEG blurs" in str(read_picture(picture(tmp_path / "screen.jpg"), FONT, None).problem)


def test_a_picture_of_26_4_is_read(tmp_path: Path) -> None:
    entries = ("game_version", "player_position")
    screen = F3Screen("26.4", 2, (8.5, 64.0, -3.25), 0.0, 65.0, version="26.4", entries=entries, has_f3=False)
    assert read_picture(picture(tmp_path / "26.4.png", screen), FONT, None).xyz == (8.5, 64.0, -3.25)


WIDTH, HEIGHT = 854, 480
TITLE_BAR, DESKTOP = 230, 90


def window(layout: Layout, scale: int = 2) -> Frame:
    screen = F3Screen(layout, scale, (8.5, 64.0, -3.25), 0.0, -65.0)
    return paint(np.full((HEIGHT, WIDTH, 3), 60, np.uint8), screen, FONT)


def on_desktop(frame: Frame, left: int, top: int, right: int, below: int) -> Frame:
    """Return the window with so many pixels of the desktop around it, and a title bar above it if there is room."""
    desktop = np.full((HEIGHT + top + below, WIDTH + left + right, 3), DESKTOP, np.uint8)
    desktop[max(0, top - 25) : top, left : left + WIDTH] = TITLE_BAR
    desktop[top : top + HEIGHT, left : left + WIDTH] = frame
    return desktop


def shows_more(frame: Frame) -> bool:
    found = find_debug_screen(frame, FONT)
    assert found is not None
    return shows_more_than_window(found, FONT)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("scale", [1, 2])
def test_a_picture_of_the_window_alone_is_recognised(layout: Layout, scale: int) -> None:
    assert not shows_more(window(layout, scale))


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("around", [(100, 62, 300, 200), (0, 25, 0, 0), (100, 0, 0, 0)])
def test_a_picture_with_title_bar_or_desktop_is_recognised_as_more_than_the_window(
    layout: Layout, around: tuple[int, int, int, int]
) -> None:
    assert shows_more(on_desktop(window(layout), *around))


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if layout not in ("standin", "26.4")])
def test_a_window_in_the_desktops_corner_is_recognised_as_more_than_the_window(layout: Layout) -> None:
    desktop = on_desktop(window(layout), 0, 0, 300, 100)
    assert str(read_debug_screen(desktop, FONT).problem).startswith("a notice may lie over")
    assert shows_more(desktop)
