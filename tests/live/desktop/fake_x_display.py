"""A made-up connection to an X server: a keyboard mapping with spare keys, and a window that notes events."""

from types import SimpleNamespace
from typing import Any

FIRST = 9


class FakeXWindow:
    """A window that notes the events that a program makes for it."""

    def __init__(self) -> None:
        self.events: list[Any] = []

    def __window__(self) -> int:
        """Return its number, as python-xlib asks for it."""
        return 1

    def send_event(self, event: Any) -> None:
        self.events.append(event)


class FakeXDisplay:
    """An X server with 100 keys that type "x", and behind them ``spare`` keys that type nothing."""

    def __init__(self, spare: int) -> None:
        self.rows = [[ord("x"), ord("X"), 0, 0]] * 100 + [[0, 0, 0, 0]] * spare
        self.display = SimpleNamespace(info=SimpleNamespace(max_keycode=FIRST + len(self.rows) - 1))
        self.window = FakeXWindow()
        self.changes = self.syncs = 0
        self.changed: dict[int, list[int]] = {}

    def get_keyboard_mapping(self, first: int, count: int) -> list[list[int]]:
        assert (first, count) == (FIRST, len(self.rows))
        return self.rows

    def change_keyboard_mapping(self, keycode: int, rows: list[list[int]]) -> None:
        (row,) = rows
        assert len(row) == 4
        self.changes += 1
        self.changed[keycode] = self.rows[keycode - FIRST] = row

    def get_input_focus(self) -> Any:
        return SimpleNamespace(focus=self.window)

    def screen(self) -> Any:
        return SimpleNamespace(root=FakeXWindow())

    def sync(self) -> None:
        self.syncs += 1
