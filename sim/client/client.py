"""A virtual Minecraft client on a virtual clock: all that lies between the devices and the game, and what a test asks.

keyboard, pointer -> window (focus, latency) -> controls -> game, 20 ticks a second
game -> what was to be seen when (60 frames a second) -> display, 10 to 30 ms later
"""

import dataclasses
import math
from collections import deque
from functools import lru_cache
from typing import Any

import numpy as np

from mc_nested.arena.rules import Cell
from mc_nested.live.coordinates import cell_at
from mc_nested.live.devices import Button, Frame, Region
from mc_nested.live.font import Font, font_of
from mc_nested.live.profile_tables import Arena
from mc_nested.live.reading import Block
from sim.client.clock import VirtualClock
from sim.client.controls import Controls
from sim.client.devices import VirtualClipboard, VirtualDisplay, VirtualKeyboard, VirtualPointer
from sim.client.edition import Edition
from sim.client.font import drawn_atlas
from sim.client.game import Game
from sim.client.keys import BINDINGS, SIDES_SWAPPED, GameKeys
from sim.client.mishaps import Mishaps
from sim.client.painter import Painter
from sim.client.physics import Ground
from sim.client.realm import Player, Realm
from sim.client.save import read_world, write_world
from sim.client.settings import ClientSettings, Size, gui_scale
from sim.client.view import View
from sim.client.window import Window
from sim.client.world import AIR, World

TICK_S = 0.05
GRAB_S = 0.001
"""Seconds that taking a picture takes: without them, somebody who only looks would look for ever."""

PAUSE_AFTER_S = 0.5
"""Seconds without the focus after which the game pauses (FACTS: Keys)."""

MOST_TICKS = 10
"""Ticks that the game catches up with after a stall; the rest of them never happens (FACTS: Keys)."""

_KEPT_S = 0.5


class VirtualClient:
    """A game, its window and its devices.

    Args:
        settings: how it is set up.
        choices: settings by name, in place of those in ``settings``: ``VirtualClient(seed=3, version="1.12.2")``.
    """

    def __init__(self, settings: ClientSettings | None = None, **choices: Any) -> None:
        self.settings = settings = dataclasses.replace(settings or ClientSettings(), **choices)
        self.edition = Edition(settings.version)
        seeds = np.random.SeedSequence(settings.seed).spawn(4)
        inputs, captures, phases, mishaps = (np.random.default_rng(seed) for seed in seeds)
        self._captures = captures
        self.clock = VirtualClock()
        self.clipboard = VirtualClipboard()
        self.window = Window(self.clock, inputs, settings.size, settings.input_latency_s)
        self.game = Game(
            self._new_realm(),
            keys=GameKeys(SIDES_SWAPPED if settings.swaps_sides else BINDINGS),
            ground=Ground(settings.slipperiness, settings.speed),
            shows_target=settings.shows_target,
            on_leave=self._save,
            on_enter=self._load,
        )
        self.game.has_f3 = settings.has_f3
        self.controls = Controls(self.game, self.clipboard.read, self.clipboard.write)
        self.controls.pauses_unfocused = settings.pauses_unfocused
        self.display = VirtualDisplay(self)
        self.keyboard = VirtualKeyboard(self)
        self.pointer = VirtualPointer(self)
        self.mishaps = Mishaps(self, mishaps)

        self._font = settings.font or _drawn_font()
        self._painter = self._new_painter()
        self._frame_phase = self.clock.now() + float(phases.uniform(0, 1 / settings.fps))
        self._views: deque[tuple[float, View]] = deque([(-math.inf, self.game.view())])
        self._shown_at = -math.inf
        self._frozen_until, self._frozen_at = -math.inf, -math.inf
        self._black_until = -math.inf
        self._missed: int | None = None
        self._unfocused_since = math.inf
        self._ignores_move = False
        self._next_tick = self.clock.now() + float(phases.uniform(0, TICK_S))
        self.clock.call_at(self._next_tick, self._tick)

    # What a test asks.

    @property
    def realm(self) -> Realm:
        """The world as it truly is."""
        return self.game.realm

    @property
    def built(self) -> dict[Block, str]:
        """Every block that differs from the bare floor."""
        return self.realm.world.built()

    def cell(self, arena: Arena) -> Cell:
        """The arena's cell that the player truly is in."""
        return cell_at(arena.place_of(self.realm.player.feet))

    def placed(self, arena: Arena) -> set[Cell]:
        """The cells of the ground floor of an arena that hold a block; blocks elsewhere are only in ``built``."""
        standing = (block for block, name in self.built.items() if name != AIR and block[1] == arena.origin[1])
        return {cell_at(arena.place_of((x + 0.5, float(y), z + 0.5))) for x, y, z in standing}

    @property
    def scale(self) -> int:
        """The GUI scale that the window gets."""
        return gui_scale(self.window.size, self.settings.scale)

    # What the devices do.

    @property
    def title(self) -> str:
        """The window's title."""
        return self.edition.title(in_world=self.game.is_in_world)

    def grab(self, region: Region | None = None) -> Frame:
        """The last frame that has got through to the desktop, or a region of it."""
        now = self.clock.now()
        least, most = self.settings.capture_latency_s
        seen = now - least - (most - least) * float(self._captures.random())
        if now < self._frozen_until:
            seen = min(seen, self._frozen_at)
        fps = self.settings.fps
        frame_at = self._frame_phase + math.floor((seen - self._frame_phase) * fps) / fps
        # A desktop never shows an older frame than before.
        self._shown_at = max(self._shown_at, frame_at)
        frame = self._painter.grab(self._view_at(self._shown_at), region)
        if now < self._black_until:
            frame = np.zeros_like(frame)
        self.clock.sleep(GRAB_S)
        return frame

    def pointer_position(self) -> tuple[int, int]:
        """Where the mouse is; in the window's middle while the game holds it."""
        if self._holds_pointer():
            return self.window.size[0] // 2, self.window.size[1] // 2
        return self.window.pointer

    def move_pointer(self, x: int, y: int) -> None:
        """The mouse goes there; while the game holds it, the view turns by as much as that is off the middle."""
        if not self._holds_pointer():
            self.window.pointer = (x, y)
            self.game.pointer = self._gui(x, y)
            self._ignores_move = True
            return
        if self._ignores_move:
            # The first movement after the game has taken the mouse is lost (FACTS: Keys).
            self._ignores_move = False
            return
        right, down = x - self.window.size[0] // 2, y - self.window.size[1] // 2
        self.window.tell(lambda: self.controls.turn(right, down))

    def press_button(self, button: Button, *, is_down: bool) -> None:
        """A mouse button goes down or up where the mouse is."""
        at, size = self._gui(*self.pointer_position()), self._gui_size()

        def event() -> None:
            self.controls.button(button, at, size, self.clock.now(), is_down=is_down)

        carry = self.window.press if is_down else self.window.release
        carry(f"{button} button", event)

    # What can happen to it.

    def set_front(self, *, is_in_front: bool) -> None:
        """The window comes to the front, or another one does; the game releases every key, and may pause."""
        if is_in_front == self.window.is_in_front:
            return
        self.window.is_in_front = is_in_front
        if is_in_front:
            self._unfocused_since = math.inf
            return
        since = self._unfocused_since = self.clock.now()
        self.window.tell(self.controls.lose_focus)
        self.clock.call_at(since + PAUSE_AFTER_S, lambda: self._stay_unfocused(since))

    def stall(self, seconds: float) -> None:
        """The game stands still for so long: ticks come late, then all at once, and only then what was pressed."""
        if self._missed is None:
            self._missed = 0
            self.window.stall()
            self.clock.call_at(self.clock.now() + seconds, self._catch_up)

    def freeze(self, seconds: float) -> None:
        """The desktop shows the same picture for so long, whatever the game does."""
        self._frozen_at, self._frozen_until = self.clock.now(), self.clock.now() + seconds

    def blacken(self, seconds: float) -> None:
        """The desktop shows a black picture for so long."""
        self._black_until = self.clock.now() + seconds

    def resize(self, size: Size) -> None:
        """The window gets another size, and with it perhaps another GUI scale."""
        self.window.size = size
        self._painter = self._new_painter()

    def shift_window(self, right: int, down: int) -> None:
        """The window is moved by so many pixels, and the mouse is not."""
        x, y = self.window.pointer
        self.window.pointer = (x - right, y - down)

    def _new_realm(self) -> Realm:
        settings = self.settings
        world = World(math.floor(settings.feet[1]), settings.floor_block)
        player = Player(settings.feet, settings.yaw, settings.pitch, mode=settings.mode)
        return Realm(self.edition, world, player, has_cheats=settings.has_cheats, spawn=settings.feet)

    def _save(self, realm: Realm) -> None:
        if self.settings.world_folder is not None:
            write_world(realm, self.settings.world_folder)

    def _load(self, realm: Realm) -> Realm:
        return read_world(realm, self.settings.world_folder) if self.settings.world_folder is not None else realm

    def _new_painter(self) -> Painter:
        settings, size = self.settings, self.window.size
        return Painter(size, self.scale, self._font, self.edition, settings.world, settings.seed, settings.words)

    def _tick(self) -> None:
        self._next_tick += TICK_S
        self.clock.call_at(self._next_tick, self._tick)
        if self._missed is not None:
            self._missed += 1
            return
        self.game.tick()
        self._note()

    def _catch_up(self) -> None:
        missed, self._missed = self._missed or 0, None
        for _ in range(min(missed, MOST_TICKS)):
            self.game.tick()
        self._note()
        self.window.resume()

    def _note(self) -> None:
        """Note what is to be seen from now on."""
        view, now = self.game.view(), self.clock.now()
        if view != self._views[-1][1]:
            self._views.append((now, view))
        while len(self._views) > 1 and self._views[1][0] < min(now - _KEPT_S, self._shown_at):
            self._views.popleft()

    def _view_at(self, at: float) -> View:
        return next((view for since, view in reversed(self._views) if since <= at), self._views[0][1])

    def _stay_unfocused(self, since: float) -> None:
        if self._unfocused_since == since:
            self.controls.stay_unfocused()

    def _holds_pointer(self) -> bool:
        return self.window.is_in_front and self.game.screen == "world"

    def _gui(self, x: int, y: int) -> tuple[int, int]:
        return x // self.scale, y // self.scale

    def _gui_size(self) -> tuple[int, int]:
        width, height = self.window.size
        return -(-width // self.scale), -(-height // self.scale)


@lru_cache(1)
def _drawn_font() -> Font:
    return font_of(drawn_atlas())
