"""The chat's region on a picture, by hand and against the virtual client's own chat.

The last frames before a failure, over a display of the test's own; test_chat_region.py has what is blanked.

Lines of chat are counted, and cleared before they cover the debug screen.
"""

from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame, Region
from mc_nested.live.menus.chat import Chat
from mc_nested.live.profile.tables import GameVersion, Profile
from mc_nested.live.vision.chat_region import (
    BLANK,
    LINES,
    SHOWN_S,
    ChatLines,
    LastFrames,
    blanked_share,
    chat_regions,
    chat_room,
    without_chat,
)
from mc_nested.live.vision.game_screen import WindowScreen
from scripts.benches.live import connection_to
from sim.client.client import VirtualClient
from sim.client.drawing.gui_layers import HudLayers
from sim.client.drawing.layers import draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.chat import ChatLine, TypedLine
from sim.client.game.edition import Edition
from sim.client.game.widgets import WHITE
from sim.client.settings import gui_scale
from tests.sim.client.playing import FONT, tap


def test_the_chat_covers_the_lower_left_and_the_typed_line_at_854_x_480() -> None:
    # 228 to 38 dots above the lower edge, 332 wide; all of the 38 below, where lines are typed.
    assert chat_regions((854, 480), 2) == (Region(0, 24, 664, 380), Region(0, 404, 854, 76))


@pytest.mark.parametrize(("size", "scale"), [((854, 480), 2), ((854, 480), None), ((1280, 720), 1), ((200, 50), 3)])
def test_blanked_share_agrees_with_the_blanked_pixels(size: tuple[int, int], scale: int | None) -> None:
    blank = (without_chat(np.zeros((*size[::-1], 3), np.uint8), scale) == BLANK).all(axis=2)
    assert blanked_share(size, scale) == blank.mean()


def test_at_854_x_480_and_scale_2_four_fifths_are_blanked() -> None:
    assert blanked_share((854, 480), 2) == pytest.approx((664 * 380 + 854 * 76) / (854 * 480))


@given(st.integers(320, 2000), st.integers(240, 1300))
def test_an_unknown_gui_scale_blanks_the_chat_of_every_scale(width: int, height: int) -> None:
    frame = np.zeros((height, width, 3), np.uint8)
    blank = without_chat(frame, None) == BLANK
    for scale in range(1, min(width // 320, height // 240) + 1):
        assert blank[without_chat(frame, scale) == BLANK].all()


@given(st.integers(1, 3000), st.integers(1, 2000), st.one_of(st.none(), st.integers(1, 8)))
def test_the_chat_regions_never_reach_out_of_the_window(width: int, height: int, scale: int | None) -> None:
    for region in chat_regions((width, height), scale):
        assert region.left >= 0
        assert region.left + region.width <= width
        assert region.top >= 0
        assert region.top + region.height <= height


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1", "26.1"])
@pytest.mark.parametrize(("size", "scale"), [((854, 480), 1), ((1280, 720), 3)])
def test_no_chat_message_is_left_on_the_picture(version: str, size: tuple[int, int], scale: int) -> None:
    def seen(words: str) -> Frame:
        client = VirtualClient(version=version, size=size, scale=scale, capture_latency_s=(0.0, 0.0))
        for line in range(12):
            client.game.chat.say(f"<Ann> {words} {line}", client.game.ticks)
        client.clock.sleep(0.3)
        return client.display.grab()

    one, other = seen("meet me at the oak, as always, at eight"), seen("i will be a bit late, it is raining")
    scale = gui_scale(size, scale)
    assert not np.array_equal(one, other)
    assert np.array_equal(without_chat(one, scale), without_chat(other, scale))


@pytest.mark.parametrize("version", ["1.12.2", "26.1"])
def test_no_typed_letter_is_left_on_the_picture(version: str) -> None:
    def seen(words: str) -> Frame:
        client = VirtualClient(version=version, capture_latency_s=(0.0, 0.0))
        tap(client, "t")
        client.keyboard.type(words)
        client.clock.sleep(0.3)
        return client.display.grab()

    one, other = seen("meet me at the oak"), seen("i will be a bit late")
    assert not np.array_equal(one, other)
    assert np.array_equal(without_chat(one, 2), without_chat(other, 2))


def chat_over(size: tuple[int, int], scale: int, version: str, said: list[str], typed: str) -> Frame:
    """Return a grey window with a chat in it, painted as the facts say."""
    letters, gui = Letters(FONT, scale), (-(-size[0] // scale), -(-size[1] // scale))
    lines = tuple(ChatLine(text, WHITE, 8) for text in said)
    frame: Frame = np.full((size[1], size[0], 3), 120, np.uint8)
    draw_all(frame, HudLayers(letters, gui, Edition(version)).chat(lines, TypedLine(typed)), (0, 0, *size))
    return frame


@given(
    st.integers(320, 1000),
    st.integers(240, 700),
    st.integers(1, 4),
    st.sampled_from(["1.12.2", "1.20.1"]),
    st.booleans(),
    st.text("iIlW@.jg_", min_size=1, max_size=45),
)
def test_no_pixel_of_messages_or_of_the_typed_line_is_left_in_any_window(
    width: int, height: int, scale: int, version: str, is_known: bool, text: str
) -> None:
    size = (width, height)
    one = chat_over(size, scale, version, [text] * LINES, typed=text * 3)
    other = chat_over(size, scale, version, [], typed="")
    known = scale if is_known or scale > min(width // 320, height // 240) else None
    assert np.array_equal(without_chat(one, known), without_chat(other, known))


def test_without_chat_changes_only_the_chat_on_a_copy_and_spares_opaque_regions() -> None:
    frame = np.random.default_rng(0).integers(100, 256, (480, 427, 3), np.uint8)
    before = frame.copy()
    blanked = without_chat(frame, 1, [Region(100, 350, 50, 20), Region(-5, 470, 10, 30)])
    assert np.array_equal(frame, before)
    assert np.array_equal(blanked[:252], frame[:252])
    assert np.array_equal(blanked[350:370, 100:150], frame[350:370, 100:150])
    assert np.array_equal(blanked[470:, :5], frame[470:, :5])
    assert (blanked[252:350, :332] == BLANK).all()
    assert np.array_equal(blanked[252:442, 332:], frame[252:442, 332:])


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
    """Return the shade in the upper right of each picture, where no chat is."""
    return [int(picture[0, -1, 0]) for path in paths if (picture := cv2.imread(str(path))) is not None]


def test_the_last_three_frames_are_written_the_oldest_first(tmp_path: Path) -> None:
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


def test_without_a_folder_the_window_is_looked_at_as_with_one_and_nothing_is_saved() -> None:
    display = GreyDisplay()
    last = LastFrames(display, None, lambda: 1)
    last.take()
    assert (last.save(), display.grabs) == ([], 1)


def test_save_leaves_out_a_picture_that_can_not_be_written(tmp_path: Path) -> None:
    (tmp_path / "last-1.png").mkdir()
    display = GreyDisplay()
    last = LastFrames(display, tmp_path, lambda: 1)
    last.take()
    last.take()
    assert last.save() == [tmp_path / "last-2.png"]


@pytest.mark.parametrize("version", ["1.12.2", "26.1"])
@pytest.mark.parametrize(("size", "scale"), [((854, 480), 2), ((1280, 721), 3)])
def test_a_line_being_typed_can_not_be_read_on_the_last_frames(
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
def test_a_typed_line_can_not_be_read_on_the_last_frames_at_an_unknown_scale(
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


def test_a_long_open_chat_can_not_be_read_on_the_last_frames(tmp_path: Path) -> None:
    # Of 180 dots, 20 lines, from 40 above the lower edge, in 1.12 48.
    display = GreyDisplay()
    last = LastFrames(display, tmp_path, lambda: 1)
    display.shade = 200
    last.take()
    picture = cv2.imread(str(last.save()[0]))
    assert picture is not None
    chat = picture[300 - 48 - 180 : 300 - 40, : 4 + 320]
    assert (chat != 200).all()


RESET = (
    "/tp @s 0.5 64 0.5 0 65",
    "/fill 20 64 20 22 65 22 minecraft:air",
    "/fill 20 63 20 22 63 22 minecraft:stone keep",
    "/tp @s 0.5 64 0.5 0 65",
    "/time set 6000",
    "/time set 6000",
)


@pytest.mark.parametrize("version", ["1.12.2", "1.13.2", "1.14.4", "1.15.2", "1.16.5", "1.20.1"])
def test_the_smallest_window_is_read_after_each_command_of_two_resets(version: str) -> None:
    client = VirtualClient(version=version, size=(854, 480), scale=2, pitch=65.0)
    connection = connection_to(client)
    chat = Chat(Profile(game=GameVersion(version=version)), connection)
    for command in (*RESET, *RESET):
        assert connection.screen.read().target is not None, command
        connection.controller.confirm_screen("world")
        chat.send(command)
        client.clock.sleep(0.2)
    assert connection.screen.read().problem is None


def cleared(version: str, size: tuple[int, int], scale: int) -> int:
    """Return how often the chat is cleared in a reset of five lines."""
    client = VirtualClient(version=version, size=size, scale=scale, pitch=65.0)
    connection, count = connection_to(client), 0
    forget = client.game.chat.clear

    def counted() -> None:
        nonlocal count
        count += 1
        forget()

    client.game.chat.clear = counted  # type: ignore[method-assign]
    chat = Chat(Profile(game=GameVersion(version=version)), connection)
    for command in RESET[1:4] + RESET[1:2]:
        assert connection.screen.read().problem is None
        connection.controller.confirm_screen("world")
        chat.send(command)
    return count


def test_a_reset_clears_the_chat_once_only_where_its_fifth_line_covers_the_block() -> None:
    assert cleared("1.13.2", (854, 480), 2) == 1
    assert cleared("1.13.2", (1920, 1080), 4) == 0
    assert [cleared(version, (854, 480), 2) for version in ("1.12.2", "1.20.1", "1.21.9", "26.4")] == [0, 0, 0, 0]


def test_chat_lines_that_have_faded_are_not_counted() -> None:
    lines = ChatLines()
    lines.note("/tp @s 0 0 0", 1.0)
    lines.note("/fill", 2.0)
    assert lines.after("/fill", 3.0) == 4
    assert lines.after("/fill", 2.5 + SHOWN_S) == 2
    lines.forget()
    assert lines.after("/fill", 3.0) == 0


def test_chat_room_is_limited_only_from_1_9_to_1_21_8() -> None:
    assert [chat_room(version) for version in ("1.8.9", "1.9", "1.13", "1.16", "1.21.9")] == [None, 6, 4, 8, None]
    assert chat_room("1.13.2", 270) == 7
