"""A rehearsal: a virtual client played in a real window, in real time, until the window is closed.

Mishaps may happen to the window. The client writes the world as it truly is into a file that tests read.
"""

import dataclasses
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import moderngl
import numpy as np

from mc_nested.atomic_file import atomic_write
from mc_nested.errors import DesktopError
from mc_nested.live.model.reading import Block
from sim.client.client import VirtualClient
from sim.client.mishaps import Mishaps
from sim.client.settings import ClientSettings
from sim.window.frame_pacer import FramePacer
from sim.window.glfw_window import GlfwWindow, now, open_glfw_window, refresh_rate
from sim.window.input_events import InputEvents
from sim.window.window_picture import WindowPicture


class TruthFile:
    """One JSON object, written anew at each frame in which something has changed, before that frame is shown.

    ``screen``, ``feet`` (blocks), ``way`` (of each of the last ticks the number, and the feet after it), ``yaw`` and
    ``pitch`` (degrees), ``block_in_hand``, ``keys_down``, ``is_in_front``, and ``built``: x, y, z and the name of each
    block that differs from the bare floor.
    """

    def __init__(self, path: Path, client: VirtualClient) -> None:
        self._path, self._client = path, client
        self._seen: Mapping[Block, str] = {}
        self._built: list[list[int | str]] = []
        self._written: dict[str, Any] = {}

    def write(self) -> None:
        """Write it, unless nothing has changed but the time."""
        truth = {**truth_of(self._client), "built": self._listed(self._client.realm.world.seen())}
        changes = {**truth, "way": None}
        if changes == self._written:
            return
        self._written = changes
        with atomic_write(self._path) as unfinished:
            unfinished.write_text(json.dumps(truth), encoding="utf-8")

    def _listed(self, built: Mapping[Block, str]) -> list[list[int | str]]:
        """Return each block's x, y, z and name, in order; the same list again for the same mapping."""
        if built is not self._seen:
            self._seen, self._built = built, [[*block, name] for block, name in sorted(built.items())]
        return self._built


def truth_of(client: VirtualClient) -> dict[str, Any]:
    """Return what the file holds, but for ``built``."""
    player = client.realm.player
    stack = player.hotbar[player.slot]
    return {
        "screen": client.game.screen,
        "feet": player.feet,
        "way": list(client.way),
        "yaw": player.yaw,
        "pitch": player.pitch,
        "block_in_hand": stack.block if stack else None,
        "keys_down": sorted(client.game.keys.physical),
        "is_in_front": client.window.is_in_front,
    }


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
            Mishaps(client, rng, window).every(rehearsal.mishaps_a_minute / 60)
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
