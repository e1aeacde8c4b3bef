"""A rehearsal: a virtual client played in a real window, in real time, until the window is closed."""

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import moderngl
import numpy as np

from mc_nested.errors import DesktopError
from sim.client.client import VirtualClient
from sim.client.mishaps import Mishaps
from sim.client.settings import ClientSettings
from sim.window.frame_pacer import FramePacer
from sim.window.glfw_window import GlfwWindow, now, open_glfw_window, refresh_rate
from sim.window.input_events import InputEvents
from sim.window.mishap_window import MishapWindow
from sim.window.truth_file import TruthFile
from sim.window.window_picture import WindowPicture


@dataclass(frozen=True)
class Rehearsal:
    """The settings of a rehearsal.

    ``settings`` is the client's; its frames and latencies are the window's own. ``fps`` is None for the monitor's rate.
    Keys reach the game, and pictures the window, ``lag_s`` seconds later. ``truth`` is the file for tests, if any.
    """

    settings: ClientSettings
    fps: float | None = None
    lag_s: float = 0.0
    mishaps_a_minute: float = 0.0
    truth: Path | None = None


def rehearse(rehearsal: Rehearsal, on_open: Callable[[], None]) -> None:
    """Open the window, call ``on_open``, and return when it is closed; DesktopError where none can be opened."""
    with open_glfw_window(f"Minecraft {rehearsal.settings.version}", rehearsal.settings.size) as window:
        context = _context()
        fps, lag = rehearsal.fps or refresh_rate(), (rehearsal.lag_s, rehearsal.lag_s)
        settings = dataclasses.replace(
            rehearsal.settings, fps=math.inf, shown_fps=fps, input_latency_s=lag, capture_latency_s=lag
        )
        client = VirtualClient(settings, clipboard=window)
        client.resize(window.size)
        if rehearsal.mishaps_a_minute:
            rng = np.random.default_rng(settings.seed)
            Mishaps(MishapWindow(window, client), rng).every(rehearsal.mishaps_a_minute / 60)
        truth = TruthFile(rehearsal.truth, client) if rehearsal.truth else None
        on_open()
        _run(window, WindowPicture(context, client), client, fps, truth)


def _run(
    window: GlfwWindow, picture: WindowPicture, client: VirtualClient, fps: float, truth: TruthFile | None
) -> None:
    """Run the game's loop: wait for the frame and take events meanwhile, run the ticks that are due, draw."""
    events = InputEvents(window, client)
    pacer = FramePacer(client.clock, fps, now())
    title = ""
    while not window.is_closing:
        window.wait_until(pacer.next_frame)
        pacer.begin_frame(now())
        events.follow_screen()
        if client.display.title() != title:
            title = client.display.title()
            window.set_title(title)
        if truth:
            truth.write()
        if all(window.size) and (picture.has_changed() or window.is_stale):
            picture.draw()
            window.show()


def _context() -> moderngl.Context:
    try:
        return moderngl.create_context(require=330)
    except Exception as error:  # moderngl raises plain Exception
        raise DesktopError(f"OpenGL can't be used ({error}): update the graphics driver, or install Mesa's") from error
