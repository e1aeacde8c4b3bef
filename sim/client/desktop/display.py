"""The virtual display: the game's window as the desktop shows it, frame by frame and a little late."""

import math
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mc_nested.live.devices import Frame, Region
from sim.client.desktop.clock import VirtualClock
from sim.client.desktop.window import VirtualWindow
from sim.client.drawing.painter import Painter
from sim.client.game.view import View

GRAB_S = 0.001
"""Seconds that taking a picture takes. Without them, a loop that only looks would never end."""


_ROUNDING = 1e-6
"""Frames that a time may be off a frame's and still be the same."""


class FrameTiming(NamedTuple):
    """When frames appear: ``fps`` a second, one of them at ``phase_s``, each seen after a latency from and to."""

    fps: float
    phase_s: float
    latency_s: tuple[float, float]

    def frame(self, number: int) -> float:
        """When that frame appears, in seconds."""
        return self.phase_s + number / self.fps

    def latest(self, at: float) -> float:
        """When the latest frame appeared that is no later than ``at``."""
        return self.frame(math.floor((at - self.phase_s) * self.fps + _ROUNDING))

    def next(self, at: float) -> float:
        """When the first frame appears that is no earlier than ``at``."""
        return self.frame(math.ceil((at - self.phase_s) * self.fps - _ROUNDING))


class VirtualDisplay:
    """Pictures of the game's window. ``painter`` draws them, and is replaced when the window's size changes.

    Args:
        clock: the time of the frames.
        window: the window that is shown.
        rng: draws the capture latencies.
        timing: when frames appear.
        painter: draws a view.
        title: gives the window's title.
        view: what is seen at first.
    """

    def __init__(
        self,
        clock: VirtualClock,
        window: VirtualWindow,
        rng: np.random.Generator,
        timing: FrameTiming,
        painter: Painter,
        title: Callable[[], str],
        view: View,
    ) -> None:
        self._clock, self._window, self._rng, self._timing = clock, window, rng, timing
        self.painter = painter
        self._title = title
        self._views: deque[tuple[float, View]] = deque([(-math.inf, view)])
        self._shown_at = -math.inf
        self._frozen_at, self._frozen_until = -math.inf, -math.inf
        self._black_until = -math.inf

    def size(self) -> tuple[int, int]:
        return self._window.size

    def title(self) -> str:
        return self._title()

    def is_in_front(self) -> bool:
        return self._window.is_in_front

    def grab(self, region: Region | None = None) -> Frame:
        now, (least, most) = self._clock.now(), self._timing.latency_s
        seen = now - least - (most - least) * float(self._rng.random())
        if now < self._frozen_until:
            seen = min(seen, self._frozen_at)
        # A desktop never shows an older frame than before.
        self._shown_at = max(self._shown_at, self._timing.latest(seen))
        frame = self.painter.grab(self._view_at(self._shown_at), region)
        if now < self._black_until:
            frame = np.zeros_like(frame)
        self._clock.sleep(GRAB_S)
        return frame

    def show(self, view: View) -> None:
        """The game draws this view from now on."""
        if view != self._views[-1][1]:
            self._views.append((self._clock.now(), view))
        while len(self._views) > 1 and self._views[1][0] < self._shown_at:
            self._views.popleft()

    def freeze(self, seconds: float) -> None:
        """Show the same picture for some seconds, whatever the game does."""
        self._frozen_at, self._frozen_until = self._clock.now(), self._clock.now() + seconds

    def blacken(self, seconds: float) -> None:
        """Show a black picture for some seconds."""
        self._black_until = self._clock.now() + seconds

    def _view_at(self, time_s: float) -> View:
        return next((view for since, view in reversed(self._views) if since <= time_s), self._views[0][1])
