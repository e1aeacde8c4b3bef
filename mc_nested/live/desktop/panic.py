"""The real panic switch and takeover key: threads that notice a key, and the mouse in a corner, in any window.

The panic key stops always. The corner stops while the mouse is free, as in menus and other windows: in its world the
game holds the mouse in the middle of its window, and a push only turns the view (FACTS: Keys).
"""

import math
from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.desktop.key_listener import CLOSE_S, Listen, listening
from mc_nested.live.desktop.pointer import load_pyautogui
from mc_nested.live.input.stops import CORNER_REASON, KEY_REASON, Stop, Switch, corners_of
from mc_nested.live.model.keys import canonical, check_key


@contextmanager
def open_panic_switch(key: str, stop: Stop, listen: Listen = listening) -> Iterator[None]:
    """While the context lasts, ``stop`` is called as soon as the key goes down or the free mouse is in a corner.

    Needs a display: open the desktop first. Raises ProfileError for a name that no key has.
    """
    check_key(key)
    from pynput import mouse

    pyautogui, panic_key = load_pyautogui(), canonical(key)
    width, height = pyautogui.size()
    corners = corners_of(width, height)

    def on_key(name: str, is_down: bool) -> None:
        if is_down and name == panic_key:
            stop(KEY_REASON)

    def on_move(x: float, y: float) -> None:
        at = math.floor(x), math.floor(y)
        if not (0 <= at[0] < width and 0 <= at[1] < height):
            # Windows reports where a push would lead, beyond the edge: so the mouse is asked where it is.
            at = pyautogui.position()
        if tuple(at) in corners:
            stop(CORNER_REASON)

    with listen(on_key), mouse.Listener(on_move=on_move) as moves:
        moves.wait()
        yield
    # It closes its connection to the display some time after it is stopped.
    moves.join(CLOSE_S)


@contextmanager
def open_takeover_key(key: str, switch: Switch, listen: Listen = listening) -> Iterator[None]:
    """While the context lasts, ``switch`` is called each time the key goes down; needs what the panic switch does."""
    takeover_key, down = canonical(key), set[str]()

    def on_key(name: str, is_down: bool) -> None:
        if not is_down:
            down.discard(name)
        elif name == takeover_key and name not in down:  # a key that is held long goes down repeatedly
            down.add(name)
            switch()

    with listen(on_key):
        yield
