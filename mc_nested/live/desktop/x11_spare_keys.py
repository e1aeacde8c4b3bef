"""Keys of an X server that type nothing, lent to characters that the keyboard's layout lacks.

A window looks up what a key types when it handles the key's event, and may have missed a change of the layout by then,
or for good if it came while another one was being reread, as it seems. So the keys are lent once, all together,
announced again when that is over, and never changed until they are given back (FACTS: Input and windows).
"""

import time
from collections.abc import Mapping, Sequence

from Xlib import X
from Xlib.display import Display

_SECOND_GROUP = 1 << 13
"""The bits of a key event's state that say which group of the layout counts (the XKB protocol, section 2.2.2)."""

STATES = (0, X.ShiftMask, _SECOND_GROUP, _SECOND_GROUP | X.ShiftMask)
"""A key's four characters, in the order of the server's mapping, and the state that an event must have to mean each."""

SEEN_S = 0.05
"""Seconds after which a window has seen that the layout changed, and has reread it."""

_FIRST_KEYCODE = 9
"""Keycode 8 is evdev's 0, which is reserved."""


class SpareKeys:
    """The spare keys of a display; each holds up to four characters."""

    def __init__(self, display: Display) -> None:
        self._display = display
        self._lent: dict[int, list[int]] = {}

    def lend(self, keysyms: Sequence[int]) -> Mapping[int, tuple[int, int]]:
        """Put keysyms on spare keys; return the keycode and the state that type each, as far as there are keys."""
        last: int = self._display.display.info.max_keycode
        mapping = self._display.get_keyboard_mapping(_FIRST_KEYCODE, last - _FIRST_KEYCODE + 1)
        spare = [_FIRST_KEYCODE + index for index, on_key in enumerate(mapping) if not any(on_key)]
        found: dict[int, tuple[int, int]] = {}
        for keycode, first in zip(spare, range(0, len(keysyms), len(STATES)), strict=False):
            on_key = keysyms[first : first + len(STATES)]
            # None is left empty: a letter beside nothing would count as its lower and its upper case (X11 protocol,
            # section 5).
            self._lent[keycode] = [*on_key, *[on_key[-1]] * (len(STATES) - len(on_key))]
            found |= {keysym: (keycode, state) for keysym, state in zip(on_key, STATES, strict=False)}
        self._change(self._lent)
        if self._lent:
            time.sleep(SEEN_S)
            self._change(self._lent)
        return found

    def close(self) -> None:
        """Take every character off the keys again."""
        self._change(dict.fromkeys(self._lent, [X.NoSymbol] * len(STATES)))
        self._lent.clear()

    def _change(self, keys: Mapping[int, list[int]]) -> None:
        """Send all changes in one go, so that a window sees them together."""
        for keycode, row in keys.items():
            self._display.change_keyboard_mapping(keycode, [row])
        self._display.sync()
