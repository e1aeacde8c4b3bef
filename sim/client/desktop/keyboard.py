"""The virtual keyboard: keys at their places, which make what a layout has there."""

from functools import partial

from mc_nested.live.model.key_names import canonical
from mc_nested.live.model.key_places import NAME_AT_EVDEV, KeyPlace
from mc_nested.live.model.key_symbols import Layout
from sim.client.desktop.layouts import characters_of, taken_by_lwjgl
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls

_SHIFTS = frozenset({"left.shift", "right.shift"})


class VirtualKeySender:
    """Keys and characters that reach the game through its window, as a desktop sends them.

    A key that is pressed also types what the layout has there. Typed text presses the keys that have its characters,
    as text does on X11 and macOS; a character that is on no key comes alone, as every one does on Windows.

    Args:
        window: which gets them while it is in front.
        controls: what they do in the game.
        layout: the layout's name, of ``layouts.LAYOUTS``.
        is_lwjgl_2: whether the game takes a key by what it makes, as to 1.12, and not by its place.
    """

    def __init__(
        self, window: VirtualWindow, controls: Controls, layout: str = "us", *, is_lwjgl_2: bool = False
    ) -> None:
        self._window, self._controls, self._is_lwjgl_2 = window, controls, is_lwjgl_2
        self._characters = characters_of(layout)
        self._lwjgl = taken_by_lwjgl(self._characters)
        self._places = {plain: place for place, (plain, _) in self._characters.items()}

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        name = NAME_AT_EVDEV[place.evdev]
        has_shift = bool(_SHIFTS & self._window.down)
        plain, shifted = self._characters.get(name, (" ", " ") if name == "space" else ("", ""))
        key = self._taken_for(name, has_shift=has_shift)
        if is_down:
            self._window.press(name, partial(self._go_down, key, shifted if has_shift else plain))
        else:
            self._window.release(name, partial(self._go_up, key))

    def type(self, character: str) -> None:
        name = "space" if character == " " else canonical(character)
        key = name if self._is_lwjgl_2 else self._places.get(name, name)
        self._window.press(character, partial(self._go_down, key, character))
        self._window.release(character, partial(self._go_up, key))

    def layout(self) -> Layout:
        return self._lwjgl

    def _taken_for(self, place: str, *, has_shift: bool) -> str:
        """The key that the game takes the one at a place for, going down or up; "" for none."""
        if not self._is_lwjgl_2 or place not in self._lwjgl:
            return place
        plain, shifted = self._lwjgl[place]
        return (shifted or plain) if has_shift else plain

    def _go_down(self, key: str, typed: str) -> None:
        if key:
            self._controls.key(key, is_down=True)
        if typed:
            self._controls.character(typed)

    def _go_up(self, key: str) -> None:
        if key:
            self._controls.key(key, is_down=False)
