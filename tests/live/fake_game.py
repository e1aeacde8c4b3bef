"""A small Minecraft on a clock of its own, behind the device protocols: walking, placing, chat commands, focus.

It knows nothing of the code it tests: walking, looking and placing are the facts' formulas, in world coordinates.
"""

import heapq
import itertools
import math
import re
from collections.abc import Callable, Collection
from dataclasses import dataclass, field

import numpy as np

from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Button, Devices, Frame, Keyboard, Pointer, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.reading import Block, Reading, Target
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.game_screen import GameScreen
from mc_nested.live.vision.layout import Scales
from mc_nested.live.vision.menu_labels import MenuButton

TICK = 0.05
FLOOR = "smooth_stone"


class FakeClock:
    """Time that passes only when somebody sleeps; each sleep ends ``late`` seconds late."""

    def __init__(self, late: float = 0.0) -> None:
        self.time = 100.0
        self.late = late
        self.slept: list[float] = []

    def now(self) -> float:
        return self.time

    def sleep_until(self, at: float) -> None:
        self.slept.append(at)
        if at > self.time:
            self.time = at + self.late


@dataclass
class FakeGame:
    """The world, the player and the window. Events reach the game ``latency`` seconds after they were sent.

    Those sent from ``late_from`` on wait until ``late_until``, in their order, while its ticks go on.
    """

    profile: Profile
    clock: FakeClock = field(default_factory=FakeClock)
    latency: float = 0.012
    phase: float = 0.02
    floor: int = 64
    xyz: tuple[float, float, float] = (0.5, 64.0, 0.5)
    yaw: float = 0.0
    pitch: float = 0.0
    blocks: dict[Block, str] = field(default_factory=dict)
    hotbar: dict[int, str] = field(default_factory=dict)
    slot: int = 0
    commands: list[str] = field(default_factory=list)
    leaked: str = ""
    down: set[str] = field(default_factory=set)
    presses: list[str] = field(default_factory=list)
    presses_behind: list[str] = field(default_factory=list)
    unreadable: bool = False
    refuse_clicks: int = 0
    front_until: float = math.inf
    refuse_commands: str = " "
    late_from: float = math.inf
    late_until: float = -math.inf

    def __post_init__(self) -> None:
        self._velocity = (0.0, 0.0)
        self._game_keys: set[str] = set()
        self._clicks = 0
        self._chat: str | None = None
        self.draft = ""
        self._events: list[tuple[float, int, Callable[[], None]]] = []
        self._count = itertools.count()
        self._next_tick = self.clock.now() + self.phase

    @property
    def is_in_front(self) -> bool:
        return self.clock.now() < self.front_until

    @property
    def built(self) -> set[Block]:
        return set(self.blocks)

    def read(self) -> Reading:
        self._catch_up()
        if self.unreadable:
            return Reading(problem="no line starts with XYZ:")
        x, y, z = self.xyz
        hit, _ = self._ray()
        shown = self.profile.blocks.shown_prefix
        target = None if hit is None else Target(hit, shown + self.blocks.get(hit, FLOOR))
        return Reading((round(x, 3), round(y, 5), round(z, 3)), round(self.yaw, 1), round(self.pitch, 1), target)

    def typed(self) -> str | None:
        """Return what the open chat holds."""
        self._catch_up()
        return self._chat

    def send(self, name: str, *, is_down: bool) -> None:
        """Return a key or button event, as the operating system takes it."""
        self._catch_up()
        if is_down:
            self.presses.append(name)
            self.down.add(name)
            if not self.is_in_front:
                self.presses_behind.append(name)
        else:
            self.down.discard(name)
        self._later(lambda: self._receive(name, is_down=is_down))

    def send_text(self, text: str) -> None:
        self._catch_up()
        if not self.is_in_front:
            self.presses_behind.append(text)
        self._later(lambda: self._receive_text(text))

    def _later(self, event: Callable[[], None]) -> None:
        now = self.clock.now()
        if self.is_in_front:
            late = self.late_until if now >= self.late_from else now
            heapq.heappush(self._events, (max(now + self.latency, late), next(self._count), event))

    def _catch_up(self) -> None:
        now = self.clock.now()
        while min(self._next_tick, self._events[0][0] if self._events else math.inf) <= now:
            if self._events and self._events[0][0] <= self._next_tick:
                heapq.heappop(self._events)[2]()
            else:
                self._tick()
                self._next_tick += TICK

    def _receive(self, name: str, *, is_down: bool) -> None:
        keys = self.profile.keys
        if not is_down:
            self._game_keys.discard(name)
        elif self._chat is not None and name == "esc":
            self._chat = None
        elif self._chat is not None:
            if name == "enter":
                self._run(self._chat)
                self._chat = None
            elif name == "backspace":
                self._chat = ""
        elif keys.debug in self._game_keys:
            pass  # with that key down a letter is a command of its own, and doesn't walk (FACTS: Keys)
        elif name == keys.chat:
            self._chat = self.draft
        elif name in keys.hotbar:
            self.slot = keys.hotbar.index(name)
        elif name == "right button":
            self._clicks += 1
        else:
            self._game_keys.add(name)

    def _receive_text(self, text: str) -> None:
        if self._chat is None:
            self.leaked += text
        else:
            self._chat += text

    def _run(self, command: str) -> None:
        self.commands.append(command)
        words = command.split() or [""]
        if command.startswith(self.refuse_commands):
            return
        if words[0] == "/fill":
            low, high = (tuple(map(int, words[start : start + 3])) for start in (1, 4))
            for block in list(self.blocks):
                if all(low[axis] <= block[axis] <= high[axis] for axis in range(3)):
                    del self.blocks[block]
        elif words[0] == "/tp" and len(words) == 7:
            x, y, z, self.yaw, self.pitch = (float(word) for word in words[2:])
            self.xyz, self._velocity = (x, y, z), (0.0, 0.0)
        elif found := re.search(r"hotbar\.(\d) (?:with )?minecraft:(\w+) 64", command):
            self.hotbar[int(found[1])] = found[2]

    def _tick(self) -> None:
        if not self.is_in_front:
            self._game_keys.clear()
        for _ in range(self._clicks):
            self._place()
        self._clicks = 0
        self._walk()

    def _walk(self) -> None:
        keys, held = self.profile.keys, self._game_keys
        forward = (keys.forward in held) - (keys.back in held)
        left = (keys.left in held) - (keys.right in held)
        sine, cosine = math.sin(math.radians(self.yaw)), math.cos(math.radians(self.yaw))
        push = 0.98 * 0.1 * 0.1627714 / 0.546**3
        wish = (left * cosine - forward * sine, forward * cosine + left * sine)
        x, y, z = self.xyz
        speeds = [speed if abs(speed) >= 0.003 else 0.0 for speed in self._velocity]
        speeds = [speed + push * part for speed, part in zip(speeds, wish, strict=True)]
        if self._is_free((x + speeds[0], y, z)):
            x += speeds[0]
        if self._is_free((x, y, z + speeds[1])):
            z += speeds[1]
        self.xyz, self._velocity = (x, y, z), (speeds[0] * 0.546, speeds[1] * 0.546)

    def _is_free(self, feet: tuple[float, float, float]) -> bool:
        return not any(_overlaps(feet, block) for block in self.blocks)

    def _place(self) -> None:
        if self.refuse_clicks > 0:
            self.refuse_clicks -= 1
            return
        hit, before = self._ray()
        if hit is not None and self.slot in self.hotbar and not _overlaps(self.xyz, before):
            self.blocks[before] = self.hotbar[self.slot]

    def _ray(self) -> tuple[Block | None, Block]:
        """Return the target block within reach, and the free one before it."""
        yaw, pitch = math.radians(self.yaw), math.radians(self.pitch)
        way = (-math.sin(yaw) * math.cos(pitch), -math.sin(pitch), math.cos(yaw) * math.cos(pitch))
        eye = (self.xyz[0], self.xyz[1] + 1.62, self.xyz[2])
        before = _block_at(eye)
        for step in range(450):
            block = _block_at(
                (eye[0] + way[0] * step / 100, eye[1] + way[1] * step / 100, eye[2] + way[2] * step / 100)
            )
            if block in self.blocks or block[1] < self.floor:
                return block, before
            before = block
        return None, before


class NoMenu:
    """A menu that isn't there."""

    def shows(self, text: str) -> bool:
        return text == ""

    def button(self, label: str) -> MenuButton:
        return MenuButton(problem=f"no {label!r}")


class FakeScreen:
    """The fake game's screen, without pixels. ``readings`` come first, then what the game says."""

    def __init__(self, game: FakeGame, readings: Callable[[], Reading | None] = lambda: None) -> None:
        self._game = game
        self._readings = readings

    def read(self) -> Reading:
        return self._readings() or self._game.read()

    def read_position(self) -> tuple[float, float, float] | None:
        return self.read().xyz

    def shows_world(self) -> bool:
        return not self.is_chat_open()

    def shows_death(self) -> bool:
        return False

    def is_chat_open(self) -> bool:
        return self._game.typed() is not None

    def is_typed(self, text: str) -> bool:
        return self._game.typed() == text

    def menu(self) -> NoMenu:
        return NoMenu()

    def position_of(self, text: str) -> tuple[int, int] | None:
        raise NotImplementedError(f"the fake game has no menu, nor {text!r} on it")

    def gui_scale(self) -> int:
        return 2

    def seen_scales(self) -> Scales | None:
        return Scales(2, 2)


class FakeDisplay:
    """The fake game's window; its picture is black, since tests read the world itself."""

    def __init__(self, game: FakeGame) -> None:
        self._game = game

    def size(self) -> tuple[int, int]:
        return 854, 480

    def title(self) -> str:
        return "Minecraft 1.20.1 - Singleplayer"

    def is_in_front(self) -> bool:
        return self._game.is_in_front

    def grab(self, region: Region | None = None) -> Frame:
        height, width = (region.height, region.width) if region else self.size()[::-1]
        return np.zeros((height, width, 3), np.uint8)


class FakeKeyboard:
    """The fake game's keys. ``fail_after`` calls, one call fails."""

    def __init__(self, game: FakeGame, fail_after: int = -1) -> None:
        self._game = game
        self._calls_left = fail_after

    def go_by_symbols(self, keys: Collection[str]) -> None:
        raise NotImplementedError(f"the fake game goes by places, for {keys}, too")

    def press(self, key: str) -> None:
        self._game.send(key, is_down=True)
        self._fail_in_turn()

    def release(self, key: str) -> None:
        self._fail_in_turn()
        self._game.send(key, is_down=False)

    def type(self, text: str) -> None:
        self._fail_in_turn()
        self._game.send_text(text)

    def _fail_in_turn(self) -> None:
        self._calls_left -= 1
        if self._calls_left == -1:
            raise OSError("the keyboard is gone")


class FakePointer:
    """The fake game's buttons."""

    def __init__(self, game: FakeGame) -> None:
        self._game = game

    def position(self) -> tuple[int, int]:
        return 427, 240

    def move(self, x: int, y: int) -> None:
        raise NotImplementedError(f"nothing in the live path moves the pointer, not to {x}, {y}")

    def press(self, button: Button) -> None:
        self._game.send(f"{button} button", is_down=True)

    def release(self, button: Button) -> None:
        self._game.send(f"{button} button", is_down=False)


class FakeClipboard:
    """A clipboard that holds what was written."""

    def __init__(self) -> None:
        self.text = ""

    def read(self) -> str:
        return self.text

    def write(self, text: str) -> None:
        self.text = text


def devices_of(game: FakeGame, keyboard: Keyboard | None = None, pointer: Pointer | None = None) -> Devices:
    """Return the fake game's devices, with another keyboard or pointer if one is given."""
    return Devices(
        FakeDisplay(game), keyboard or FakeKeyboard(game), pointer or FakePointer(game), game.clock, FakeClipboard()
    )


def connection_to(game: FakeGame, screen: GameScreen | None = None, fail_after: int = -1) -> GameConnection:
    """Return the fake game, read by its own screen unless another is given; its keyboard may fail after some calls."""
    devices = devices_of(game, FakeKeyboard(game, fail_after))
    return GameConnection(devices, InputController(devices, game.profile.input), screen or FakeScreen(game))


def _block_at(point: tuple[float, float, float]) -> Block:
    return math.floor(point[0]), math.floor(point[1]), math.floor(point[2])


def _overlaps(feet: tuple[float, float, float], block: Block) -> bool:
    x, y, z = feet
    return (
        x - 0.3 < block[0] + 1 and x + 0.3 > block[0]
        and y < block[1] + 1 and y + 1.8 > block[1]
        and z - 0.3 < block[2] + 1 and z + 0.3 > block[2]
    )  # fmt: skip
