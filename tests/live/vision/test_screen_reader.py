"""Drives ScreenReader with painted frames behind a display that notes its pictures; reading is left to others.

The sign that no block is looked at: the same as long as none is, another one as soon as one is.
"""

import dataclasses

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Target
from mc_nested.live.vision import screen_reader
from mc_nested.live.vision.debug_screen import read_debug_screen, read_lines
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.screen_reader import ScreenReader, shows_no_block, sign_of_no_block
from scripts.benches.f3_cases import expected, random_screen
from scripts.benches.painted_screen import paint
from sim.client.drawing.painter import WORLDS, random_world
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from tests.sim.client.playing import FONT


class Pictures:
    """A Display that shows ``frame``, and remembers which regions were pictured."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.grabbed: list[Region | None] = []

    def size(self) -> tuple[int, int]:
        return self.frame.shape[1], self.frame.shape[0]

    def title(self) -> str:
        return "Minecraft 1.20.1 - Singleplayer"

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        self.grabbed.append(region)
        if region is None:
            return self.frame
        return self.frame[region.top : region.top + region.height, region.left : region.left + region.width]


def screen(layout: Layout = "1.16-1.19.2", x: float = 8.5) -> F3Screen:
    name = "stone" if layout == "standin" else "minecraft:stone"
    return F3Screen(layout, 2, (x, 64.0, 3.5), 0.0, 65.0, Target((8, 63, 4), name))


def painted(shown: F3Screen, width: int = 860, height: int = 480) -> Frame:
    return paint(np.full((height, width, 3), 120, np.uint8), shown, FONT)


def opened(shown: F3Screen) -> tuple[ScreenReader, Pictures]:
    """Return a reader that has read this screen once."""
    pictures = Pictures(painted(shown))
    reader = ScreenReader(pictures, FONT)
    assert reader.read() == expected(shown)
    pictures.grabbed.clear()
    return reader, pictures


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_second_reading_pictures_only_the_rows_of_the_first_ones_lines(layout: Layout) -> None:
    reader, pictures = opened(screen(layout))
    moved = screen(layout, x=8.716)
    pictures.frame = painted(moved)
    assert reader.read() == expected(moved)
    (region,) = pictures.grabbed
    assert region is not None
    assert region.height < 480 * 0.75


def test_the_block_of_a_mod_is_reread_in_the_oldest_layout() -> None:
    shown = dataclasses.replace(screen("1.8-1.12"), target=Target((8, 63, 4), "some-mod:machine"))
    reader, pictures = opened(shown)
    assert reader.read() == expected(shown)
    assert None not in pictures.grabbed


def test_lines_that_moved_are_found_and_remembered() -> None:
    reader, pictures = opened(screen())
    for change in (screen(x=-10.5), screen("1.13-1.15"), dataclasses.replace(screen(), gui_scale=1)):
        pictures.frame = painted(change)
        assert reader.read() == expected(change)
        assert pictures.grabbed.pop() is None or change.layout == "1.16-1.19.2"
        pictures.grabbed.clear()
        assert reader.read() == expected(change)
        assert None not in pictures.grabbed
        pictures.grabbed.clear()


@pytest.mark.parametrize("size", [(1000, 480), (700, 480), (860, 260), (330, 60)])
def test_a_resized_window_is_read_as_by_a_new_reader(size: tuple[int, int]) -> None:
    reader, pictures = opened(screen())
    pictures.frame = painted(screen(x=9.5), *size)
    assert reader.read() == read_debug_screen(pictures.frame, FONT)


def test_no_target_is_reported_only_after_picturing_the_whole_window() -> None:
    reader, pictures = opened(screen())
    sky = dataclasses.replace(screen(), target=None)
    pictures.frame = painted(sky)
    for _ in range(2):
        assert reader.read() == expected(sky)
        assert pictures.grabbed.pop() is None


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if layout != "standin"])
def test_a_new_target_block_is_seen_by_the_next_reading(layout: Layout) -> None:
    block = screen(layout)
    sky = dataclasses.replace(block, target=None)
    reader, pictures = opened(sky)
    for shown in (sky, dataclasses.replace(sky, xyz=(9.0, 64.0, 3.5)), block, sky, block):
        pictures.frame = painted(shown)
        assert reader.read() == expected(shown)


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if layout != "standin"])
def test_a_second_reading_without_a_target_needs_no_search(layout: Layout, monkeypatch: pytest.MonkeyPatch) -> None:
    # So small that 26.4's columns leave room for a block.
    sky = dataclasses.replace(screen(layout), target=None, gui_scale=1)
    reader, pictures = opened(sky)
    monkeypatch.setattr(screen_reader, "find_debug_screen", lambda *_: pytest.fail("searched"))
    pictures.frame = painted(dataclasses.replace(sky, xyz=(9.0, 64.0, 3.5)))
    assert reader.read().xyz == (9.0, 64.0, 3.5)


def test_an_unchanged_read_only_picture_is_not_read_again() -> None:
    sky = dataclasses.replace(screen(), target=None)  # so the whole window is pictured each time
    reader, pictures = opened(sky)
    pictures.frame = painted(sky)
    pictures.frame.flags.writeable = False
    first, look = reader.read(), reader.last_look
    assert first == expected(sky)
    assert reader.read() is first
    assert reader.last_look is look


def test_a_writeable_picture_is_read_each_time() -> None:
    sky = dataclasses.replace(screen(), target=None)
    reader, pictures = opened(sky)
    moved = dataclasses.replace(sky, xyz=(9.0, 64.0, 3.5))
    pictures.frame[:] = painted(moved)
    assert reader.read() == expected(moved)


def spoilt(frame: Frame, name: str) -> Frame:
    if name == "shifted":
        return np.roll(frame, 7, 0)
    if name == "covered":
        frame[:, 100:140] = 255
        return frame
    return frame // {"black": 255, "dimmed": 3}[name]


@pytest.mark.parametrize("name", ["black", "dimmed", "covered", "shifted"])
def test_a_damaged_frame_is_read_as_by_a_new_reader_and_does_not_disturb_the_next(name: str) -> None:
    reader, pictures = opened(screen())
    pictures.frame = spoilt(painted(screen()), name)
    assert reader.read() == read_debug_screen(pictures.frame, FONT)
    pictures.frame = painted(screen(x=9.0))
    assert reader.read() == expected(screen(x=9.0))


@given(st.sampled_from(LAYOUTS), st.sampled_from(WORLDS), st.integers(0, 2**32 - 1))
@example("26.4", "flat", 158584097)  # another box begins where a letter of the block's id ends
def test_successive_screens_are_read_as_by_a_new_reader(layout: Layout, kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    pictures = Pictures(np.zeros((480, 860, 3), np.uint8))
    reader = ScreenReader(pictures, FONT)
    first = random_screen(rng, layout, 2)
    later = dataclasses.replace(first, xyz=(first.xyz[0] + 0.216, first.xyz[1], first.xyz[2]))
    for shown in (first, later, random_screen(rng, layout, 2)):
        pictures.frame = paint(random_world(rng, kind, 860, 480), shown, FONT)
        reading = reader.read()
        assert reading == read_debug_screen(pictures.frame, FONT)
        assert reading.problem or reading == expected(shown)


GAMES = [layout for layout in LAYOUTS if layout != "standin"]


def sky(layout: Layout, **more: object) -> F3Screen:
    return dataclasses.replace(F3Screen(layout, 1, (8.5, 64.0, 3.5), 0.0, 65.0), **more)  # type: ignore[arg-type]


def painted_on_noise(shown: F3Screen, seed: int = 0) -> Frame:
    return paint(random_world(np.random.default_rng(seed), "grey noise", 860, 480) // 2, shown, FONT)


def lines_of(frame: Frame) -> ScreenLines:
    found = find_debug_screen(frame, FONT)
    assert found is not None
    lines = ScreenLines(found.dots, FONT, found.overlay)
    assert read_lines(lines).problem is None
    return lines


@pytest.mark.parametrize("layout", GAMES)
def test_the_sign_of_no_block_survives_a_move_and_disappears_with_a_block(layout: Layout) -> None:
    lines = lines_of(painted_on_noise(sky(layout)))
    sign = sign_of_no_block(lines, FONT)
    assert sign is not None
    assert shows_no_block(painted_on_noise(sky(layout, xyz=(9.25, 64.0, 3.5), yaw=90.0), 1), lines.overlay, sign)
    block = sky(layout, target=Target((8, 63, 4), "minecraft:stone"))
    assert not shows_no_block(painted_on_noise(block), lines.overlay, sign)


@pytest.mark.parametrize("layout", ["1.21.9-26.3", "26.4"])
def test_an_entity_in_sight_gives_no_sign_of_no_block(layout: Layout) -> None:
    entries = ("looking_at_block_state", "looking_at_entity", "player_position")
    shown = sky(layout, entries=entries, entity=(8.5, 64.0, 5.5), has_f3=False)
    assert sign_of_no_block(lines_of(painted_on_noise(shown)), FONT) is None


def test_columns_without_room_for_a_block_give_no_sign_of_no_block() -> None:
    frame = painted_on_noise(sky("26.4"))
    assert sign_of_no_block(lines_of(frame), FONT) is not None
    assert sign_of_no_block(lines_of(frame[:260]), FONT) is None


def test_a_shifted_picture_of_boxes_gives_no_sign_of_no_block() -> None:
    assert sign_of_no_block(lines_of(np.pad(painted_on_noise(sky("26.4")), ((31, 0), (5, 5), (0, 0)))), FONT) is None
