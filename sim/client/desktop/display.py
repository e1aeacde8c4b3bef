"""The virtual display: the game's window as the desktop shows it, frame by frame and a little late."""

import math
from collections import deque
from collections.abc import Callable

import numpy as np

from mc_nested.live.devices import DesktopArea, Frame, Region
from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.window import VirtualWindow
from sim.client.drawing.painter import Painter
from sim.client.game.view import View

GRAB_S = 0.001
"""Seconds that taking a picture takes. Without them, a loop that only looks would never end."""


class VirtualDisplay:
    """Pictures of the game's window. ``painter`` draws them, and is replaced when the window's size changes.

    Args:
        clock: the time of the frames.
        window: the window that is shown.
        rng: draws the capture latencies.
        frames: when the game draws.
        latency_s: the shortest and the longest time until a frame is seen, in seconds.
        painter: draws a view.
        title: gives the window's title.
        view: what is seen at first.
    """

    def __init__(
        self,
        clock: VirtualClock,
        window: VirtualWindow,
        rng: np.random.Generator,
        frames: Frames,
        latency_s: tuple[float, float],
        painter: Painter,
        title: Callable[[], str],
        view: View,
    ) -> None:
        self._clock, self._window, self._rng = clock, window, rng
        self._frames, self._latency_s = frames, latency_s
        self.painter = painter
        self._title = title
        self._views: deque[tuple[float, View]] = deque([(-math.inf, view)])
        self.shown_at = -math.inf
        """The time at which the game drew the frame that was seen last, in seconds."""
        self._frozen_at, self._frozen_until = -math.inf, -math.inf
        self._black_until = -math.inf

    def size(self) -> tuple[int, int]:
        return self._window.size

    def title(self) -> str:
        return self._title()

    def is_in_front(self) -> bool:
        return self._window.is_in_front

    def area(self) -> DesktopArea:
        """Return the area of the whole desktop, which its only monitor fills."""
        return DesktopArea(0, 0, *self.size())

    def grab(self, region: Region | None = None) -> Frame:
        frame = self.painter.grab(self.seen(), region)
        if self.is_black():
            frame = np.zeros_like(frame)
        self._clock.sleep(GRAB_S)
        return frame

    def seen(self) -> View:
        """Return what the desktop shows now of what the game drew."""
        now, (least, most) = self._clock.now(), self._latency_s
        seen = now - least - (most - least) * float(self._rng.random())
        if now < self._frozen_until:
            seen = min(seen, self._frozen_at)
        # A desktop never shows an older frame than before.
        self.shown_at = max(self.shown_at, self._frames.at_or_before(seen))
        return next((view for since, view in reversed(self._views) if since <= self.shown_at), self._views[0][1])

    def is_black(self) -> bool:
        """Return whether the desktop shows a black picture now."""
        return self._clock.now() < self._black_until

    def show(self, view: View) -> None:
        """Draw this view from now on."""
        if view != self._views[-1][1]:
            self._views.append((self._clock.now(), view))
        while len(self._views) > 1 and self._views[1][0] < self.shown_at:
            self._views.popleft()

    def freeze(self, seconds: float) -> None:
        """Show the same picture for some seconds, whatever the game does."""
        self._frozen_at, self._frozen_until = self._clock.now(), self._clock.now() + seconds

    def blacken(self, seconds: float) -> None:
        """Show a black picture for some seconds."""
        self._black_until = self._clock.now() + seconds
