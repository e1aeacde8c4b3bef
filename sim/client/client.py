"""A virtual Minecraft client on a virtual clock: the game, its window and its devices, put together.

keyboard, pointer -> window (focus, latency) -> controls -> game, 20 ticks a second, run on its frames
game -> views, each with the time of its frame (60 a second) -> display, 10 to 30 ms later
"""

import dataclasses
import math
from collections import deque
from typing import Any

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.live.desktop.keyboard import DesktopKeyboard
from mc_nested.live.devices import Clipboard, Devices
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import Arena
from mc_nested.live.vision.layout import Scales
from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.display import VirtualDisplay
from sim.client.desktop.keyboard import VirtualKeySender
from sim.client.desktop.pointer import VirtualPointer
from sim.client.desktop.window import VirtualClipboard, VirtualWindow
from sim.client.drawing.letters import drawn_font
from sim.client.drawing.painter import SEEN, Painter, ViewLayers
from sim.client.game.controls import Controls
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.keys import BINDINGS, SIDES_SWAPPED, GameKeys
from sim.client.game.physics import Ground, Vector
from sim.client.game.realm import Player, Realm, read_world, write_world
from sim.client.game.view import View
from sim.client.game.world import AIR, VirtualWorld
from sim.client.mishaps import Mishaps
from sim.client.settings import ClientSettings, Size, scales

TICK_S = 0.05

WAY_TICKS = 100
"""Ticks for which it is kept where the player was: longer than an action takes."""

PAUSE_AFTER_S = 0.5
"""Seconds without the focus after which the game pauses (FACTS: Keys)."""

MOST_TICKS = 10
"""Ticks that the game makes up for after a stall; the others never happen (FACTS: Keys)."""


class VirtualClient:
    """A game, its window and its devices.

    Args:
        settings: how it is set up.
        clipboard: the desktop's clipboard; None for one of its own.
        joins: another client, on another desktop, whose world this one's player joins; they share a clock.
        choices: settings by name, in place of those in ``settings``: ``VirtualClient(seed=3, version="1.12.2")``.
    """

    def __init__(
        self,
        settings: ClientSettings | None = None,
        clipboard: Clipboard | None = None,
        joins: "VirtualClient | None" = None,
        **choices: Any,
    ) -> None:
        self.settings = settings = dataclasses.replace(settings or ClientSettings(), **choices)
        self.edition = Edition(settings.version)
        seeds = np.random.SeedSequence(settings.seed).spawn(4)
        inputs, captures, phases, mishaps = (np.random.default_rng(seed) for seed in seeds)
        self.clock: VirtualClock = joins.clock if joins else VirtualClock()
        self.clipboard: Clipboard = clipboard or VirtualClipboard()
        self._frames = Frames(settings.fps, self.clock.now() + float(phases.uniform(0, 1 / settings.fps)))
        self.window = VirtualWindow(self.clock, self._frames, inputs, settings.size, settings.input_latency_s)
        self.game = VirtualGame(
            self._new_realm(joins.realm if joins else None),
            keys=GameKeys(SIDES_SWAPPED if settings.swaps_sides else BINDINGS),
            ground=Ground(settings.slipperiness, settings.speed),
            debug_entries=settings.debug_entries,
            options=settings.options,
            on_leave=self._save,
            on_enter=self._load,
        )
        self.game.has_f3 = settings.has_f3
        self.controls = Controls(self.game, self.clipboard.read, self.clipboard.write)
        self.mishaps = Mishaps(self, mishaps)

        self._font = settings.font or drawn_font()
        self.display = VirtualDisplay(
            self.clock,
            self.window,
            captures,
            self._frames,
            settings.capture_latency_s,
            self._new_painter(),
            self._title,
            self._view(),
        )
        self.keyboard = DesktopKeyboard(
            VirtualKeySender(self.window, self.controls, settings.layout, is_lwjgl_2=not self.edition.since(1, 13))
        )
        self.pointer = VirtualPointer(self.clock, self.window, self.game, self.controls, lambda: self.scale)
        self.devices = Devices(
            self.display,
            self.keyboard,
            self.pointer,
            self.clock,
            self.clipboard,
            self.display.area,
            lambda: (self.display.area(),),
        )

        self.way: deque[tuple[int, Vector]] = deque([(0, settings.feet)], maxlen=WAY_TICKS)
        """Where the player was after each of the last ticks, by the tick's number, the last one last."""
        self._missed: int | None = None
        self._unfocused_since = math.inf
        self._next_tick = self.clock.now() + float(phases.uniform(0, TICK_S))
        self.clock.call_at(self._frames.at_or_after(self._next_tick), self._tick)

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
        """Return the arena's cell that the player truly is in."""
        return cell_at(arena.position_of(self.realm.player.feet))

    def placed(self, arena: Arena) -> set[Cell]:
        """Return the cells of an arena's ground floor that hold a block; blocks elsewhere are only in ``built``."""
        standing = (block for block, name in self.built.items() if name != AIR and block[1] == arena.origin[1])
        return {cell_at(arena.position_of((x + 0.5, float(y), z + 0.5))) for x, y, z in standing}

    @property
    def scales(self) -> Scales:
        """The scales that the window gets."""
        settings, options = self.settings, self.settings.options
        wanted = options.gui_scale if settings.scale is None else settings.scale
        return scales(self.window.size, wanted, options.debug_gui_scale, self.edition)

    @property
    def scale(self) -> int:
        """The GUI scale that the window gets."""
        return self.scales.gui

    def new_layers(self) -> ViewLayers:
        """Return the layers that draw a view's GUI, in the window's present size."""
        settings = self.settings
        return ViewLayers(self.window.size, self.scales, self._font, self.edition, settings.words)

    # What can happen to it.

    def turn(self, right: float, down: float) -> None:
        """Turn the view: the mouse was moved by so many pixels while the game holds it."""
        self.window.deliver(lambda: self.controls.turn(right, down))

    def set_front(self, *, is_in_front: bool) -> None:
        """Bring the window to the front, or another one; the game then releases every key, and may pause."""
        if is_in_front == self.window.is_in_front:
            return
        self.window.is_in_front = is_in_front
        if is_in_front:
            self._unfocused_since = math.inf
            return
        since = self._unfocused_since = self.clock.now()
        self.window.deliver(self.controls.lose_focus)
        self.clock.call_at(since + PAUSE_AFTER_S, lambda: self._stay_unfocused(since))

    def stall(self, seconds: float) -> None:
        """Stop the game for some seconds: its ticks then come all at once, and the input that waited after them."""
        if self._missed is None:
            self._missed = 0
            self.window.stall()
            self.clock.call_at(self.clock.now() + seconds, self._catch_up)

    def freeze(self, seconds: float) -> None:
        """Let the desktop show the same picture for some seconds, whatever the game does."""
        self.display.freeze(seconds)

    def blacken(self, seconds: float) -> None:
        """Let the desktop show a black picture for some seconds."""
        self.display.blacken(seconds)

    def resize(self, size: Size) -> None:
        """Give the window another size, and with it perhaps another GUI scale."""
        self.window.size = size
        self.display.painter = self._new_painter()

    def shift_window(self, right: int, down: int) -> None:
        """Move the window by some pixels, but not the mouse."""
        x, y = self.window.pointer
        self.window.pointer = (x - right, y - down)

    def _new_realm(self, joined: Realm | None) -> Realm:
        """Return the world as this client's player knows it: one of its own, or that of another player."""
        settings = self.settings
        world = joined.world if joined else VirtualWorld(math.floor(settings.feet[1]), settings.floor_block)
        player = Player(settings.feet, settings.yaw, settings.pitch, mode=settings.mode)
        players = joined.players if joined else []
        name = f"Player{len(players) + 1}" if joined else "Player"
        return Realm(
            self.edition,
            world,
            player,
            name,
            has_cheats=settings.has_cheats,
            spawn=settings.feet,
            rules=joined.rules if joined else {},
            players=players,
        )

    def _save(self, realm: Realm) -> None:
        if self.settings.world_folder is not None:
            write_world(realm, self.settings.world_folder)

    def _load(self, realm: Realm) -> Realm:
        return read_world(realm, self.settings.world_folder) if self.settings.world_folder is not None else realm

    def _new_painter(self) -> Painter:
        settings, size = self.settings, self.window.size
        return Painter(size, self.scales, self._font, self.edition, settings.world, settings.seed, settings.words)

    def _view(self) -> View:
        """Return what the game shows in this window."""
        settings = self.settings
        fps = round(settings.fps if settings.shown_fps is None else settings.shown_fps)
        return self.game.view(fps, self.window.size, self.scale, is_drawn=settings.world == SEEN)

    def _title(self) -> str:
        is_shared = len(self.realm.players) > 1
        state = "Multiplayer (LAN)" if is_shared else self.settings.words.get("Singleplayer", "Singleplayer")
        return self.edition.title(in_world=self.game.is_in_world, state=state)

    def _tick(self) -> None:
        self._next_tick += TICK_S
        self.clock.call_at(self._frames.at_or_after(self._next_tick), self._tick)
        self.window.poll()
        if self._missed is not None:
            self._missed += 1
            return
        self._tick_once()
        self.display.show(self._view())

    def _tick_once(self) -> None:
        self.game.tick()
        self.way.append((self.game.ticks, self.realm.player.feet))

    def _catch_up(self) -> None:
        missed, self._missed = self._missed or 0, None
        for _ in range(min(missed, MOST_TICKS)):
            self._tick_once()
        self.display.show(self._view())
        self.window.resume()

    def _stay_unfocused(self, since: float) -> None:
        if self._unfocused_since == since:
            self.controls.stay_unfocused()
