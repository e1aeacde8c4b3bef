"""The real panic switch, through pynput's listeners: threads that hear keys and mouse in any window."""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.desktop.keys import WORDS, check_key
from mc_nested.live.desktop.pointer import load_pyautogui
from mc_nested.live.panic import CORNER_REASON, KEY_REASON, Stop, corners_of

LET_GO_S = 1.0


@contextmanager
def open_panic_switch(key: str, stop: Stop) -> Iterator[None]:
    """While the context lasts, ``stop`` is called as soon as the key goes down or the mouse is in a corner.

    Needs a display: open the desktop first. Raises ProfileError for a name that no key has.
    """
    check_key(key)
    from pynput import keyboard, mouse

    corners = corners_of(*load_pyautogui().size())

    def hear_key(pressed: keyboard.Key | keyboard.KeyCode | None) -> None:
        if isinstance(pressed, keyboard.Key):
            is_it = key in WORDS and pressed is keyboard.Key[WORDS[key]]
        else:
            is_it = pressed is not None and pressed.char == key
        if is_it:
            stop(KEY_REASON)

    def hear_move(x: int, y: int) -> None:
        if (x, y) in corners:
            stop(CORNER_REASON)

    with keyboard.Listener(on_press=hear_key) as keys, mouse.Listener(on_move=hear_move) as moves:
        keys.wait()
        moves.wait()
        yield
    # They let go of the display some time after they are told to.
    for listener in (keys, moves):
        listener.join(LET_GO_S)
