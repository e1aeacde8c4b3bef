import math

import numpy as np
import pytest

from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.window import Stray, VirtualClipboard, VirtualWindow

EVER = Frames(math.inf)


class Desktop:
    """A window, and the events that reached its game, with their times."""

    def __init__(self, least: float = 0.01, most: float = 0.01, seed: int = 0, frames: Frames = EVER) -> None:
        self.clock = VirtualClock(0.0)
        self.window = VirtualWindow(self.clock, frames, np.random.default_rng(seed), (80, 60), (least, most))
        self.arrived: list[tuple[str, float]] = []

    def press(self, name: str) -> None:
        self.window.press(name, lambda: self.note(name))

    def release(self, name: str) -> None:
        self.window.release(name, lambda: self.note(f"-{name}"))

    def note(self, name: str) -> None:
        self.arrived.append((name, self.clock.now()))

    def names(self) -> list[str]:
        return [name for name, _ in self.arrived]


def test_an_event_arrives_after_its_latency() -> None:
    desktop = Desktop()
    desktop.press("w")
    assert desktop.window.down == {"w"}
    desktop.clock.sleep(0.009)
    assert desktop.arrived == []
    desktop.clock.sleep(0.5)
    assert desktop.arrived == [("w", 0.01)]


def test_latencies_lie_within_their_bounds_and_keep_the_order() -> None:
    desktop = Desktop(0.1, 0.3)
    for number in range(50):
        desktop.press(str(number))
    desktop.clock.sleep(1.0)
    assert desktop.names() == [str(number) for number in range(50)]
    times = [time for _, time in desktop.arrived]
    assert times[0] >= 0.1
    assert 0.25 < times[-1] <= 0.3


def test_a_key_pressed_behind_another_window_is_recorded_as_a_stray() -> None:
    desktop = Desktop()
    desktop.press("w")
    desktop.window.is_in_front = False
    desktop.clock.sleep(0.5)
    desktop.release("w")
    desktop.press("e")
    desktop.clock.sleep(0.5)
    assert desktop.names() == ["w"]
    assert desktop.window.strays == [Stray("e", 0.5)]
    assert desktop.window.down == {"e"}


def test_dropped_events_are_lost_one_by_one() -> None:
    desktop = Desktop()
    desktop.window.drop_next()
    desktop.window.drop_next()
    desktop.press("w")
    desktop.release("w")
    desktop.press("a")
    desktop.clock.sleep(0.5)
    assert desktop.names() == ["a"]
    assert desktop.window.to_drop == 0


def test_a_delayed_event_holds_up_the_next_one() -> None:
    desktop = Desktop()
    desktop.window.delay_next(0.2)
    desktop.press("w")
    desktop.release("w")
    desktop.clock.sleep(0.5)
    assert desktop.names() == ["w", "-w"]
    assert [time for _, time in desktop.arrived] == pytest.approx([0.21, 0.21])
    desktop.press("a")
    desktop.clock.sleep(0.5)
    assert desktop.arrived[-1][1] == pytest.approx(0.51)


def test_delivered_events_come_after_the_keys_on_their_way() -> None:
    desktop = Desktop(0.0, 0.1)
    for number in range(9):
        desktop.press(str(number))
    desktop.window.deliver(lambda: desktop.note("focus"))
    desktop.clock.sleep(0.5)
    assert desktop.names()[-1] == "focus"


def test_delivered_events_are_neither_dropped_nor_delayed() -> None:
    desktop = Desktop()
    desktop.window.drop_next()
    desktop.window.delay_next(0.2)
    desktop.window.deliver(lambda: desktop.note("focus"))
    desktop.clock.sleep(0.1)
    assert desktop.arrived == [("focus", 0.01)]


def test_a_stalled_game_takes_its_events_when_it_resumes() -> None:
    desktop = Desktop()
    desktop.window.stall()
    desktop.press("w")
    desktop.release("w")
    desktop.clock.sleep(1.0)
    assert desktop.arrived == []
    desktop.window.resume()
    assert desktop.arrived == [("w", 1.0), ("-w", 1.0)]
    desktop.press("a")
    desktop.clock.sleep(1.0)
    assert desktop.names() == ["w", "-w", "a"]


def test_the_game_takes_events_at_its_next_frame() -> None:
    desktop = Desktop(0.01, 0.01, frames=Frames(10.0, 0.03))
    desktop.press("w")
    desktop.release("w")
    desktop.clock.sleep_until(0.025)
    desktop.press("s")
    desktop.clock.sleep(1.0)
    # Arrived at 0.01, 0.01 and 0.035 s; frames are at 0.03 and 0.13 s.
    assert desktop.arrived == [("w", 0.03), ("-w", 0.03), ("s", pytest.approx(0.13))]


def test_poll_takes_an_event_that_has_arrived_once() -> None:
    desktop = Desktop(0.01, 0.01, frames=Frames(1.0, 0.5))
    desktop.press("w")
    desktop.window.poll()
    assert desktop.names() == []
    desktop.clock.sleep(0.02)
    desktop.window.poll()
    assert desktop.names() == ["w"]
    desktop.clock.sleep(2.0)
    assert desktop.names() == ["w"]


def test_written_options_are_read_back() -> None:
    clipboard = VirtualClipboard()
    assert clipboard.read() == ""
    clipboard.write("text")
    assert clipboard.read() == "text"
