import dataclasses
import json

import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.recording.text_pixels import OUTSIDE, TextPixels, paint, reads_the_same, text_pixels_of
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.screen_reader import ScreenReader
from scripts.benches import painted_screen
from sim.client.client import VirtualClient
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from tests.sim.client.playing import FONT, arena_of, command


def look_at(client: VirtualClient) -> tuple[WindowScreen, Reading]:
    screen = WindowScreen(client.display, FONT)
    return screen, screen.read()


def client_looking_at_the_floor(version: str = "1.20.1", size: tuple[int, int] = (854, 480)) -> VirtualClient:
    client = VirtualClient(seed=4, version=version, size=size)
    x, y, z = arena_of(client).origin
    command(client, f"/tp @s {x} {y} {z} 0 65")
    return client


@pytest.mark.parametrize("size", [(854, 480), (1280, 720), (1920, 1080)])
@pytest.mark.parametrize("version", ["1.12.2", "1.15.2", "1.20.1", "1.21.9"])
def test_text_pixels_alone_give_the_same_reading(version: str, size: tuple[int, int]) -> None:
    client = client_looking_at_the_floor(version=version, size=size)
    screen, reading = look_at(client)
    assert reading.target is not None
    look = screen.last_look
    assert look is not None
    text = text_pixels_of(look)
    assert text is not None
    assert reads_the_same(text, look, reading, FONT)
    canvas = np.full((size[1], size[0], 3), OUTSIDE, np.uint8)
    paint(canvas, text)
    assert read_debug_screen(canvas, FONT, text.overlay) == reading


def test_text_pixels_take_a_few_hundred_bytes_and_come_back_from_json() -> None:
    screen, _ = look_at(client_looking_at_the_floor())
    assert screen.last_look is not None
    text = text_pixels_of(screen.last_look)
    assert text is not None
    written = json.dumps(text.to_json())
    assert len(written) < 1500
    assert TextPixels.from_json(json.loads(written)) == text


def test_text_pixels_without_one_of_the_lines_give_another_reading() -> None:
    screen, reading = look_at(client_looking_at_the_floor())
    assert screen.last_look is not None
    text = text_pixels_of(screen.last_look)
    assert text is not None
    assert not reads_the_same(TextPixels(text.overlay, text.lines[1:]), screen.last_look, reading, FONT)


class Still:
    """A display that shows one picture."""

    def __init__(self, frame: Frame) -> None:
        self._frame = frame

    def size(self) -> tuple[int, int]:
        height, width = self._frame.shape[:2]
        return width, height

    def title(self) -> str:
        return ""

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        if region is None:
            return self._frame
        return self._frame[region.top : region.top + region.height, region.left : region.left + region.width]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_text_pixels_of_every_layout_give_the_same_reading(layout: Layout) -> None:
    """The stand-in's text is white: what is beside a line's box must not be."""
    name = "oak_planks" if layout == "standin" else "minecraft:oak_planks"
    target = Target((-9, 63, 12_345), name)
    drawn = F3Screen(layout, 2, (-8.5, 64.0, 12_345.678), 0.0, 65.0, target, (("snowy", "true"),))
    drawn = dataclasses.replace(drawn, entries=("looking_at_block_state", "player_position"), has_f3=False)
    reader = ScreenReader(Still(painted_screen.paint(np.full((480, 860, 3), 120, np.uint8), drawn, FONT)), FONT)
    for _ in range(2):  # the whole window, then the rows where its lines stood
        reading = reader.read()
        assert reading.target == target
        look = reader.last_look
        assert look is not None
        text = text_pixels_of(look)
        assert text is not None
        assert reads_the_same(text, look, reading, FONT)
