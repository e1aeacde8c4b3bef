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

_OF_BUTTONS = frozenset({"attack", "use"})


class GameKeys:
    """The keys as the game knows them; ``physical`` are those that its window saw go down and not up.

    ``toggled`` are the actions that one press begins and the next one ends, whatever is released (FACTS: Keys).
    """

    def __init__(self, bindings: Mapping[str, str] = BINDINGS) -> None:
        self._bindings = bindings
        self.toggled: frozenset[str] = frozenset()
        self.physical: set[str] = set()
        self._held: set[str] = set()
        self._presses: Counter[str] = Counter()

    def press(self, key: str) -> None:
        """A key goes down in the world."""
        if action := self._bindings.get(key.lower()):
            if action in self.toggled & self._held:
                self._held.discard(action)
            else:
                self._held.add(action)
            self._presses[action] += 1

    def release(self, key: str) -> None:
        """A key goes up, whatever screen is open."""
        if (action := self._bindings.get(key.lower(), "")) not in self.toggled:
            self._held.discard(action)

    def forget(self) -> None:
        """Count every key as up, and drop waiting presses: the focus is lost. What was begun by one press goes on."""
        self._held &= self.toggled
        self._presses.clear()

    def leave_world(self) -> None:
        """Forget keys as ``forget`` does, and end what a button has begun: a screen opens."""
        self.forget()
        self._held -= _OF_BUTTONS

    def read_again(self) -> None:
        """Count keys that are down again, but not mouse buttons: a screen closes."""
        self._held |= {
            action
            for key in self.physical
            if (action := self._bindings.get(key.lower())) and not key.endswith("button")
            if action not in self.toggled
        }

    def is_held(self, action: str) -> bool:
        """Return whether the key of that action is down."""
        return action in self._held

    def presses(self, action: str) -> int:
        """Return how often its key was pressed since the last call."""
        return self._presses.pop(action, 0) if self._presses else 0
