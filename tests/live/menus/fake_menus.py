"""A game of menus on a clock of its own, behind the device protocols: which screen is shown, and where presses lead."""

from collections.abc import Collection
from dataclasses import dataclass, field

import numpy as np

from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Button, Devices, Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.reading import Reading
from mc_nested.live.profile.tables import InputTable
from mc_nested.live.vision.layout import Scales
from mc_nested.live.vision.menu_labels import MenuButton
from tests.live.fake_game import FakeClipboard, FakeClock

BUTTONS: dict[str, dict[str, tuple[int, int]]] = {
    "pause": {"Back to Game": (427, 100), "Save and Quit to Title": (427, 200)},
    "death": {"Respawn": (427, 150)},
    "disconnected": {"Back to Server List": (427, 250)},
    "title": {"Singleplayer": (427, 110)},
    "worlds": {"Play Selected World": (300, 420)},
}
"""The middles of each screen's buttons, in pixels."""

LEADS_TO = {
    "Back to Game": "world",
    "Save and Quit to Title": "title",
    "Respawn": "world",
    "Back to Server List": "servers",
    "Singleplayer": "worlds",
    "Play Selected World": "world",
}
ESC_LEADS_TO = {"world": "pause", "chat": "world", "pause": "world", "inventory": "world", "servers": "title"}
TITLES = {"worlds": "Select World", "servers": "Play Multiplayer"}
PROBLEM = "no line starts with XYZ:"


@dataclass
class FakeMenus:
    """The window of a game that has nothing but screens; it is its own display, keyboard, pointer and screen reader.

    ``labels`` are those that can be read, or None for all; ``greyed`` ones can't be pressed. A world has to be chosen
    before it can be played. ``pressed`` has the keys and the positions that were clicked.
    """

    shown: str = "world"
    has_debug: bool = True
    labels: set[str] | None = None
    greyed: set[str] = field(default_factory=set)
    world_names: dict[str, tuple[int, int]] = field(default_factory=dict)
    scale: int = 2
    front_from: float = 0.0
    window_title: str = "Minecraft 1.20.1 - Singleplayer"
    frame: Frame = field(default_factory=lambda: np.zeros((480, 854, 3), np.uint8))
    clock: FakeClock = field(default_factory=FakeClock)
    pressed: list[str | tuple[int, int]] = field(default_factory=list)
    looks: int = 0
    is_chosen: bool = False
    has_red_hotbar: bool = False

    def __post_init__(self) -> None:
        self._mouse = (0, 0)

    def read(self) -> Reading:
        self.looks += 1
        if self.shown in ("world", "chat") and self.has_debug:
            return Reading((0.5, 64.0, 0.5), 0.0, 65.0)
        return Reading(problem=PROBLEM)

    def read_position(self) -> tuple[float, float, float] | None:
        return self.read().xyz

    def shows_world(self) -> bool:
        return self.shown == "world"

    def shows_death(self) -> bool:
        return self.shown == "death" and self.has_red_hotbar

    def is_chat_open(self) -> bool:
        return self.shown == "chat"

    def is_typed(self, text: str) -> bool:
        raise NotImplementedError(text)

    def menu(self) -> "FakeMenus":
        return self

    def shows(self, text: str) -> bool:
        return text == TITLES.get(self.shown) and (self.labels is None or text in self.labels)

    def button(self, label: str) -> MenuButton:
        middle = BUTTONS.get(self.shown, {}).get(label)
        if middle is None or not (self.labels is None or label in self.labels):
            return MenuButton(problem=f"no {label!r}")
        return MenuButton(middle, self._is_enabled(label), None, self.scale)

    def position_of(self, text: str) -> tuple[int, int] | None:
        return self.world_names.get(text) if self.shown == "worlds" else None

    def gui_scale(self) -> int:
        return self.scale

    def seen_scales(self) -> Scales | None:
        return Scales(self.scale, self.scale)

    def size(self) -> tuple[int, int]:
        return 854, 480

    def title(self) -> str:
        return self.window_title

    def is_in_front(self) -> bool:
        return self.clock.now() >= self.front_from

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        return self.frame

    def position(self) -> tuple[int, int]:
        return self._mouse

    def move(self, x: int, y: int) -> None:
        self._mouse = (x, y)

    def go_by_symbols(self, keys: Collection[str]) -> None:
        raise NotImplementedError(keys)

    def press(self, key: str | Button) -> None:
        if key == "left":
            self.pressed.append(self._mouse)
            self._click()
            return
        self.pressed.append(key)
        if key == "esc":
            self.shown = ESC_LEADS_TO.get(self.shown, self.shown)
        elif key == "f3" and self.shown == "world":
            self.has_debug = not self.has_debug

    def release(self, key: str | Button) -> None:
        pass

    def type(self, text: str) -> None:
        raise NotImplementedError(text)

    def _is_enabled(self, label: str) -> bool:
        return label not in self.greyed and (label != "Play Selected World" or self.is_chosen)

    def _click(self) -> None:
        for label, middle in BUTTONS.get(self.shown, {}).items():
            if middle == self._mouse:
                if self._is_enabled(label):
                    self.shown, self.is_chosen = LEADS_TO[label], False
                return
        self.is_chosen = self.shown == "worlds"


def connection_of(menus: FakeMenus) -> GameConnection:
    """Return a connection that reads and presses the fake game's menus."""
    devices = Devices(menus, menus, menus, menus.clock, FakeClipboard())
    return GameConnection(devices, InputController(devices, InputTable()), menus)
