"""The keys as the game counts them: which are down, and how often each was pressed since the last tick.

Movement counts where a key is down at a tick; everything else counts its presses (FACTS: Keys).
"""

from collections import Counter
from collections.abc import Mapping

HOTBAR = tuple(f"hotbar.{slot}" for slot in range(9))
"""The actions that choose a slot."""

BINDINGS = {
    "w": "forward",
    "s": "back",
    "a": "left",
    "d": "right",
    "space": "jump",
    " ": "jump",
    "left.shift": "sneak",
    "q": "drop",
    "e": "inventory",
    "t": "chat",
    "/": "command",
    "left button": "attack",
    "right button": "use",
    **{str(number): action for number, action in enumerate(HOTBAR, 1)},
}
"""The game's own keys."""

SIDES_SWAPPED = BINDINGS | {"a": "right", "d": "left"}
"""A and D swapped, as in the stand-in (FACTS: The stand-in)."""


class GameKeys:
    """The keys as the game knows them; ``physical`` are those that its window saw go down and not up."""

    def __init__(self, bindings: Mapping[str, str] = BINDINGS) -> None:
        self._bindings = bindings
        self.physical: set[str] = set()
        self._held: set[str] = set()
        self._presses: Counter[str] = Counter()

    def press(self, key: str) -> None:
        """A key goes down in the world."""
        if action := self._bindings.get(key.lower()):
            self._held.add(action)
            self._presses[action] += 1

    def release(self, key: str) -> None:
        """A key goes up, whatever screen is open."""
        self._held.discard(self._bindings.get(key.lower(), ""))

    def forget(self) -> None:
        """Count every key as up, and drop waiting presses: a screen opens, or the focus is lost."""
        self._held.clear()
        self._presses.clear()

    def read_again(self) -> None:
        """Count keys that are down again, but not mouse buttons: a screen closes."""
        self._held |= {
            action
            for key in self.physical
            if (action := self._bindings.get(key.lower())) and not key.endswith("button")
        }

    def is_held(self, action: str) -> bool:
        """Whether the key of that action is down."""
        return action in self._held

    def presses(self, action: str) -> int:
        """How often its key was pressed since the last call."""
        return self._presses.pop(action, 0) if self._presses else 0
