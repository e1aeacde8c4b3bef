"""Counts what was pressed for the world of a virtual client and reached a screen that lay over it instead."""

import math
from collections import deque
from collections.abc import Callable
from functools import partial

from mc_nested.live.devices import Devices
from mc_nested.live.input.input_controller import InputController, PressTarget
from mc_nested.live.profile.tables import InputTable
from sim.client.client import VirtualClient
from sim.client.desktop.display import GRAB_S
from sim.client.game.view import View

FORGOTTEN_S = 1.0
"""After this time a press is taken to have been lost on the way."""


class ScreenPresses:
    """Watches a client's presses. ``into_screens`` of them could have been seen to go wrong, ``too_late`` could not.

    A press is too late if the screen opened after the newest picture that could be had when the press was sent.
    """

    def __init__(self, client: VirtualClient) -> None:
        self.into_screens, self.too_late = 0, 0
        self._client = client
        self._meant: deque[tuple[str, float, float]] = deque()
        """Of each press on its way: its name, when it was sent, and when the newest picture to be had was drawn."""
        self._drawn_at = math.inf
        """When a screen over the world was first drawn: the game draws it at the tick after it opened."""
        display, controls = client.display, client.controls
        show, key, button = display.show, controls.key, controls.button

        def watched_show(view: View) -> None:
            if view.menu.name == "world":
                self._drawn_at = math.inf
            else:
                self._drawn_at = min(self._drawn_at, client.clock.now())
            show(view)

        def watched_key(name: str, *, is_down: bool) -> None:
            self._arrived(f"key {name}", is_down=is_down)
            key(name, is_down=is_down)

        def watched_button(name: str, *where: object, is_down: bool) -> None:
            self._arrived(f"{name} button", is_down=is_down)
            button(name, *where, is_down=is_down)  # type: ignore[arg-type]  # passed on as they came

        display.show = watched_show  # type: ignore[method-assign]  # what is called is watched and passed on
        controls.key, controls.button = watched_key, watched_button  # type: ignore[method-assign,assignment]  # too

    def controller(self) -> InputController:
        """Return the owner of held keys, whose presses are watched."""
        return _WatchedController(self._client.devices, InputTable(), self)

    def sent(self, name: str) -> None:
        """Note that something is pressed that is meant for the world."""
        client = self._client
        if client.window.is_in_front:
            now, frame_s = client.clock.now(), 1 / client.settings.fps
            surely_had = now - client.settings.capture_latency_s[1] - frame_s - GRAB_S
            self._meant.append((name, now, max(surely_had, client.display.shown_at)))

    def _arrived(self, name: str, *, is_down: bool) -> None:
        now = self._client.clock.now()
        while self._meant and now - self._meant[0][1] > FORGOTTEN_S:
            self._meant.popleft()
        meant = next((each for each in self._meant if each[0] == name), None) if is_down else None
        if meant is None:
            return
        self._meant.remove(meant)
        if self._client.game.screen == "world":
            return
        if self._drawn_at <= meant[2]:
            self.into_screens += 1
        else:
            self.too_late += 1


class _WatchedController(InputController):
    def __init__(self, devices: Devices, timing: InputTable, presses: ScreenPresses) -> None:
        super().__init__(devices, timing)
        self._presses = presses

    def _press(
        self, name: str, press: Callable[[], None], release: Callable[[], None], until: float, on: PressTarget
    ) -> None:
        if on == "world":
            press = partial(self._sent, name, press)
        super()._press(name, press, release, until, on)

    def _sent(self, name: str, press: Callable[[], None]) -> None:
        self._presses.sent(name)
        press()
