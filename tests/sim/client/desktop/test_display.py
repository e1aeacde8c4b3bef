import math

import numpy as np
import pytest

from mc_nested.live.devices import Region
from mc_nested.live.vision.layout import Scales
from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.display import GRAB_S, VirtualDisplay
from sim.client.desktop.window import VirtualWindow
from sim.client.drawing.painter import Painter
from sim.client.game.edition import Edition
from sim.client.game.screens import MenuState
from sim.client.game.view import View
from tests.sim.client.playing import FONT

SIZE = (80, 60)
PLAIN = View(MenuState("world"), (0, 64, 0))


def moved(x: int) -> View:
    """Return a view whose world is shifted by 7 pixels a block."""
    return View(MenuState("world"), (x, 64, 0))


class Shown:
    """A display of 10 frames a second, the first at 0.03 s."""

    def __init__(self, least: float = 0.05, most: float = 0.05) -> None:
        self.clock = VirtualClock(0.0)
        rng = np.random.default_rng(0)
        self.window = VirtualWindow(self.clock, Frames(math.inf), rng, SIZE, (0.0, 0.0))
        self.painter = Painter(SIZE, Scales(1, 1), FONT, Edition("1.20.1"), "noise", 0)
        frames = Frames(10.0, 0.03)
        title = "Minecraft 1.20.1"
        self.display = VirtualDisplay(
            self.clock, self.window, rng, frames, (least, most), self.painter, lambda: title, PLAIN
        )

    def shows(self, view: View) -> bool:
        other = Painter(SIZE, Scales(1, 1), FONT, Edition("1.20.1"), "noise", 0)
        return bool(np.array_equal(self.display.grab(), other.grab(view)))


def test_the_display_says_its_windows_title_size_and_focus() -> None:
    shown = Shown()
    assert shown.display.size() == SIZE
    assert shown.display.title() == "Minecraft 1.20.1"
    assert shown.display.is_in_front()
    shown.window.is_in_front = False
    shown.window.size = (100, 60)
    assert not shown.display.is_in_front()
    assert shown.display.size() == (100, 60)


def test_a_grab_takes_a_millisecond() -> None:
    shown = Shown()
    shown.display.grab(Region(0, 0, 1, 1))
    assert shown.clock.now() == GRAB_S == 0.001


@pytest.mark.parametrize(("wait", "is_seen"), [(0.17, False), (0.181, True)])
def test_a_view_is_seen_one_latency_after_the_next_frame(wait: float, is_seen: bool) -> None:
    shown = Shown()
    shown.clock.sleep(0.1)
    shown.display.show(moved(1))
    # The next frame is at 0.13 s, and is seen at 0.18 s.
    shown.clock.sleep_until(wait)
    assert shown.shows(moved(1) if is_seen else PLAIN)


def test_no_grab_shows_an_older_view_than_the_grab_before() -> None:
    shown = Shown(0.0, 0.4)
    pictures = [Painter(SIZE, Scales(1, 1), FONT, Edition("1.20.1"), "noise", 0).grab(moved(x)) for x in range(16)]
    order = []
    for x in range(16):
        shown.display.show(moved(x))
        for _ in range(4):
            shown.clock.sleep(0.02)
            frame = shown.display.grab()
            order.append(next(x for x, picture in enumerate(pictures) if np.array_equal(frame, picture)))
    assert order == sorted(order)
    assert order[-1] > 10


def test_a_frozen_display_shows_the_frame_of_that_time() -> None:
    shown = Shown()
    shown.clock.sleep(1.0)
    shown.display.freeze(1.0)
    shown.display.show(moved(1))
    shown.clock.sleep(0.9)
    assert shown.shows(PLAIN)
    shown.clock.sleep(0.2)
    assert shown.shows(moved(1))


def test_a_black_display_keeps_its_size() -> None:
    shown = Shown()
    shown.display.blacken(0.5)
    assert not shown.display.grab().any()
    assert shown.display.grab(Region(0, 0, 3, 2)).shape == (2, 3, 3)
    shown.clock.sleep(0.5)
    assert shown.display.grab().any()


def test_the_right_view_is_shown_after_a_hundred_views() -> None:
    shown = Shown()
    for step in range(1, 100):
        shown.clock.sleep(0.1)
        shown.display.show(moved(step))
    shown.clock.sleep(0.04)
    # 9.9 s is the time of the last view: at 9.94 s the frame of 9.83 s shows the view of 9.8 s.
    assert shown.shows(moved(98))


def test_a_replaced_painter_draws_from_the_next_grab_on() -> None:
    shown = Shown()
    shown.display.painter = Painter((40, 30), Scales(1, 1), FONT, Edition("1.20.1"), "flat", 0)
    assert shown.display.grab().shape == (30, 40, 3)
