from typing import Any

import numpy as np

from sim.client.client import VirtualClient
from sim.client.mishaps import Mishaps


class NotedWindow:
    """A real window's part, which only notes what is asked of it."""

    def __init__(self) -> None:
        self.noted: list[tuple[str, Any]] = []

    def set_front(self, *, is_in_front: bool) -> None:
        self.noted.append(("front", is_in_front))

    def resize(self, size: tuple[int, int]) -> None:
        self.noted.append(("size", size))

    def shift_window(self, right: int, down: int) -> None:
        self.noted.append(("shift", (right, down)))


def mishaps() -> tuple[NotedWindow, VirtualClient, Mishaps]:
    window, client = NotedWindow(), VirtualClient()
    return window, client, Mishaps(client, np.random.default_rng(0), window)


def test_mishaps_of_the_desktop_are_done_to_the_real_window() -> None:
    window, client, planned = mishaps()
    for kind in ("resized_window", "moved_window", "lost_focus"):
        planned.plan(kind)
    client.clock.sleep(3.0)
    assert [name for name, _ in window.noted] == ["size", "shift", "front", "front"]
    assert window.noted[2:] == [("front", False), ("front", True)]
    assert client.window.size == (854, 480), "the window says its new size itself"


def test_mishaps_of_the_game_are_done_to_the_client() -> None:
    window, client, planned = mishaps()
    planned.plan("black_frame")
    client.clock.sleep(0.01)
    assert client.display.is_black()
    client.clock.sleep(1.0)
    planned.plan("frozen_frame")
    planned.plan("lag")
    ticks = client.game.ticks
    client.clock.sleep(0.09)
    assert client.game.ticks <= ticks + 1
    planned.plan("death")
    client.clock.sleep(3.0)
    assert client.game.screen == "death"
    assert window.noted == []
