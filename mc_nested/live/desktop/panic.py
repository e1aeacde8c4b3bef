"""The real panic switch, through pynput's listeners: threads that notice keys and mouse in any window."""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.desktop.pointer import load_pyautogui
from mc_nested.live.input.panic import CORNER_REASON, KEY_REASON, Stop, corners_of
from mc_nested.live.model.key_names import WORDS, check_key

CLOSE_S = 1.0
"""Seconds that a listener gets to close its connection to the display."""


@contextmanager
def open_panic_switch(key: str, stop: Stop) -> Iterator[None]:
    """While the context lasts, ``stop`` is called as soon as the key goes down or the mouse is in a corner.

    Needs a display: open the desktop first. Raises ProfileError for a name that no key has.
    """
    check_key(key)
    from pynput import keyboard, mouse

    corners = corners_of(*load_pyautogui().size())

    def on_press(pressed: keyboard.Key | keyboard.KeyCode | None) -> None:
        if isinstance(pressed, keyboard.Key):
            is_it = key in WORDS and pressed is keyboard.Key[WORDS[key]]
        else:
            is_it = pressed is not None and pressed.char == key
        if is_it:
            stop(KEY_REASON)

    def on_move(x: int, y: int) -> None:
        if (x, y) in corners:
            stop(CORNER_REASON)

    with keyboard.Listener(on_press=on_press) as keys, mouse.Listener(on_move=on_move) as moves:
        keys.wait()
        moves.wait()
        yield
    # They close their connection to the display some time after they are stopped.
    for listener in (keys, moves):
        listener.join(CLOSE_S)
