"""The last frames before a failure, over a display of the test's own; test_chat_region.py has what is blanked."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.last_frames import LastFrames
from sim.client.client import VirtualClient
from tests.sim.client.playing import FONT, tap


class GreyDisplay:
    """A Display of one shade, which the test changes."""

    def __init__(self) -> None:
        self.shade = 0
        self.is_seen = True
        self.grabs = 0

    def size(self) -> tuple[int, int]:
        return 400, 300

    def title(self) -> str:
        return "Minecraft"

    def is_in_front(self) -> bool:
        return self.is_seen

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        self.grabs += 1
        return np.full((300, 400, 3), self.shade, np.uint8)


def shades(paths: list[Path]) -> list[int]:
    """The shade in the upper right of each picture, where no chat is."""
    return [int(picture[0, -1, 0]) for path in paths if (picture := cv2.imread(str(path))) is not None]


def test_the_last_three_are_written_the_oldest_first(tmp_path: Path) -> None:
    display = GreyDisplay()
    last = LastFrames(display, tmp_path / "new" / "evidence", lambda: 1)
    for display.shade in (10, 20, 30, 40):
        last.take()
    paths = last.save()
    assert [path.name for path in paths] == ["last-1.png", "last-2.png", "last-3.png"]
    assert shades(paths) == [20, 30, 40]


def test_another_window_is_never_pictured(tmp_path: Path) -> None:
    display = GreyDisplay()
    display.is_seen = False
    last = LastFrames(display, tmp_path, lambda: 1)
    last.take()
    assert (last.save(), display.grabs) == ([], 0)


def test_without_a_folder_nothing_is_kept() -> None:
    display = GreyDisplay()
    last = LastFrames(display, None, lambda: 1)
    last.take()
    assert (last.save(), display.grabs) == ([], 0)


def test_a_picture_that_the_disk_refuses_is_not_named(tmp_path: Path) -> None:
    (tmp_path / "last-1.png").mkdir()
    display = GreyDisplay()
    last = LastFrames(display, tmp_path, lambda: 1)
    last.take()
    last.take()
    assert last.save() == [tmp_path / "last-2.png"]


@pytest.mark.parametrize("version", ["1.12.2", "26.1"])
@pytest.mark.parametrize(("size", "scale"), [((854, 480), 2), ((1280, 721), 3)])
def test_what_is_being_typed_can_not_be_read_on_them(
    version: str, size: tuple[int, int], scale: int, tmp_path: Path
) -> None:
    def saved(words: str) -> Frame:
        client = VirtualClient(version=version, size=size, scale=scale, capture_latency_s=(0.0, 0.0))
        tap(client, "t")
        client.keyboard.type(words)
        client.clock.sleep(0.3)
        last = LastFrames(client.display, tmp_path / words[:4], lambda: client.scale)
        last.take()
        picture = cv2.imread(str(last.save()[0]))
        assert picture is not None
        return np.asarray(picture, np.uint8)

    # The end of a long line stands at the window's right side.
    one, other = saved("meet me at the oak " * 6), saved("i will be a bit late " * 6)
    assert np.array_equal(one, other)


@pytest.mark.parametrize("size", [(854, 480), (1920, 1080)])
def test_where_no_debug_screen_says_the_scale_what_is_typed_can_not_be_read_either(
    size: tuple[int, int], tmp_path: Path
) -> None:
    def saved(words: str) -> Frame:
        client = VirtualClient(size=size, scale=0, has_f3=False, capture_latency_s=(0.0, 0.0))
        client.clock.sleep(0.2)
        screen = WindowScreen(client.display, FONT)
        tap(client, "t")
        client.keyboard.type(words)
        client.clock.sleep(0.3)
        assert screen.seen_scales() is None
        last = LastFrames(client.display, tmp_path / words[:4], lambda: None)
        last.take()
        picture = cv2.imread(str(last.save()[0]))
        assert picture is not None
        return np.asarray(picture, np.uint8)

    assert np.array_equal(saved("meet me at the oak " * 6), saved("i will be a bit late " * 6))


def test_what_a_long_open_chat_shows_can_not_be_read_on_them(tmp_path: Path) -> None:
    # Of 180 dots, 20 lines, from 40 above the lower edge, in 1.12 48.
    display = GreyDisplay()
    last = LastFrames(display, tmp_path, lambda: 1)
    display.shade = 200
    last.take()
    picture = cv2.imread(str(last.save()[0]))
    assert picture is not None
    chat = picture[300 - 48 - 180 : 300 - 40, : 4 + 320]
    assert (chat != 200).all()
