"""Where the chat lies on a picture, by hand and against the virtual client's own chat."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.chat_region import BLANK, LINES, blanked_share, chat_regions, without_chat
from sim.client.client import VirtualClient
from sim.client.drawing.hud_layers import HudLayers
from sim.client.drawing.layers import draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.chat import ChatLine, TypedLine
from sim.client.game.colours import WHITE
from sim.client.game.edition import Edition
from sim.client.settings import gui_scale
from tests.sim.client.playing import FONT, tap


def test_at_854_x_480_and_scale_2_it_is_the_lower_left_and_the_lowest_line() -> None:
    # 228 to 38 dots above the lower edge, 332 wide; all of the 38 below, where lines are typed.
    assert chat_regions((854, 480), 2) == (Region(0, 24, 664, 380), Region(0, 404, 854, 76))


@pytest.mark.parametrize(("size", "scale"), [((854, 480), 2), ((854, 480), None), ((1280, 720), 1), ((200, 50), 3)])
def test_the_share_that_is_blanked_is_what_is_blanked(size: tuple[int, int], scale: int | None) -> None:
    blank = (without_chat(np.zeros((*size[::-1], 3), np.uint8), scale) == BLANK).all(axis=2)
    assert blanked_share(size, scale) == blank.mean()


def test_at_854_x_480_and_scale_2_four_fifths_are_blanked() -> None:
    assert blanked_share((854, 480), 2) == pytest.approx((664 * 380 + 854 * 76) / (854 * 480))


@given(st.integers(320, 2000), st.integers(240, 1300))
def test_without_a_scale_all_is_blanked_that_is_at_any_scale(width: int, height: int) -> None:
    frame = np.zeros((height, width, 3), np.uint8)
    blank = without_chat(frame, None) == BLANK
    for scale in range(1, min(width // 320, height // 240) + 1):
        assert blank[without_chat(frame, scale) == BLANK].all()


@given(st.integers(1, 3000), st.integers(1, 2000), st.one_of(st.none(), st.integers(1, 8)))
def test_it_never_reaches_out_of_the_window(width: int, height: int, scale: int | None) -> None:
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
def test_nothing_that_is_being_typed_is_left_on_the_picture(version: str) -> None:
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
    """A grey window with a chat in it, painted as the facts say."""
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


def test_the_rest_of_the_picture_and_what_is_opaque_stay_and_the_frame_itself_is_left_alone() -> None:
    frame = np.random.default_rng(0).integers(100, 256, (480, 427, 3), np.uint8)
    before = frame.copy()
    blanked = without_chat(frame, 1, [Region(100, 350, 50, 20), Region(-5, 470, 10, 30)])
    assert np.array_equal(frame, before)
    assert np.array_equal(blanked[:252], frame[:252])
    assert np.array_equal(blanked[350:370, 100:150], frame[350:370, 100:150])
    assert np.array_equal(blanked[470:, :5], frame[470:, :5])
    assert (blanked[252:350, :332] == BLANK).all()
    assert np.array_equal(blanked[252:442, 332:], frame[252:442, 332:])
