"""How many lines the chat shows over the world, and how many it may before it covers some of the debug screen's.

What was sent within ten seconds is counted, not seen: a line that covers a part of the debug screen makes all of it
unreadable, and then nothing may be pressed (FACTS: Answers).
"""

from collections import deque
from collections.abc import Iterable

from mc_nested.live.model.versions import draws_text_over_menus, version_numbers

SHOWN_S = 10.0
"""How long a line shows."""

_ANSWER_S = 1.0
"""By how much an answer may come later than what was sent."""

_MOST = 10
"""Lines that show at most."""

_ANSWERS = {"/fill": 1, "/item": 1, "/replaceitem": 1, "/tp": 2}
"""Lines of an answer, 320 GUI pixels wide: the place of a teleport may need a second."""

_LONGEST_ANSWER = 3

_LOWEST_HEIGHT, _LINE = 240, 9
"""GUI pixels: the height of the smallest window, which the room is counted in, and of a line."""


class ChatLines:
    """What was sent through the chat of one game, and when; times are the clock's, in seconds."""

    def __init__(self) -> None:
        self._sent: deque[tuple[float, int]] = deque(maxlen=_MOST)

    def note(self, command: str, now: float) -> None:
        """A command was sent."""
        self._sent.append((now, answer_lines(command)))

    def after(self, command: str, now: float) -> int:
        """Lines that may show once a command is answered."""
        shown = sum(lines for sent, lines in self._sent if now - sent < SHOWN_S + _ANSWER_S)
        return shown + answer_lines(command) if shown else 0

    def forget(self) -> None:
        """The chat was cleared."""
        self._sent.clear()

    @property
    def state(self) -> tuple[tuple[float, int], ...]:
        """What is known: when something was sent, and how many lines its answer may take."""
        return tuple(self._sent)

    def go_on_from(self, state: Iterable[tuple[float, int]]) -> None:
        """Go on with another game's ``state``, of the same clock."""
        self._sent = deque(state, maxlen=_MOST)


def answer_lines(command: str) -> int:
    """Lines that the answer to a command may take."""
    return _ANSWERS.get(command.split(" ", 1)[0], _LONGEST_ANSWER)


def chat_room(version: str, gui_height: int = _LOWEST_HEIGHT) -> int | None:
    """Lines that cover nothing that is read, in a window of that height in GUI pixels; None: any number, or no remedy.

    To 1.12 and, lower, to 1.15 the place of the block looked at is in the left column. To 1.8 no key clears the chat;
    from 1.21.9 on the debug screen lies over it (FACTS: The F3 debug screen; Keys).
    """
    numbers = version_numbers(version)
    if numbers < (1, 9) or draws_text_over_menus(version):
        return None
    room = 6 if numbers < (1, 13) else 4 if numbers < (1, 16) else 8
    return room + max(0, gui_height - _LOWEST_HEIGHT) // _LINE
