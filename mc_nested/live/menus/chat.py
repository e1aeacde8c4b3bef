"""Typing commands into the chat; each line is read back before it is sent.

chat key -> the line is seen, emptied -> letters -> the line is seen to hold all of them -> Enter -> the line is gone
"""

from collections.abc import Callable

from mc_nested.errors import NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Deadline
from mc_nested.live.menus.screens import LABELS
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import TYPING_LOOK_S
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import chat_room

PATIENCE_S = 1.5
"""How long the chat's line may take to look as it should."""

_CHANGED = ", as where an input method (IBus, Fcitx, an IME) changes letters: switch it to plain letters"
"""What may keep a line from being seen as it was typed (FACTS: Input and windows)."""

LETTERS_PER_LOOK = 8
"""Letters typed between two looks."""

CLEAR = "d"
"""With the debug screen's key it clears the chat (FACTS: Keys)."""


class Chat:
    """Sends lines. The caller has just seen that the world is on the screen, and nothing over it.

    The chat is cleared before answers would cover what is read of the debug screen.

    Raises (everything): NotConfirmedError where the chat's line doesn't look as it should; nothing is sent then.
    """

    def __init__(self, profile: Profile, connection: GameConnection) -> None:
        self._key, self._debug_key = profile.keys.chat, profile.keys.debug
        self._version = profile.game.version
        self._is_counted = profile.input.reads_chat and chat_room(self._version) is not None
        self._lines, self._display = connection.chat_lines, connection.devices.display
        self._timing = profile.input
        self._controller = connection.controller
        self._screen = connection.screen
        self._clock = connection.devices.clock
        self._journal = connection.journal

    def send(self, line: str) -> None:
        """Open the chat, type one line, send it, and wait until the game takes keys again.

        A chat that doesn't look as it should is closed before the error is raised.
        """
        self._journal.note("types", line=line)
        try:
            self._send(line)
        except NotConfirmedError:
            self._close()
            raise

    def clear(self) -> None:
        """Clear the chat; the world must have been seen just before, as for ``send``."""
        now = self._clock.now()
        # Together, by one look: a letter without the debug key would walk.
        self._controller.wait_until(self._controller.press(now + 2 * TICK_S, self._debug_key, CLEAR))
        self._lines.forget()

    def _send(self, line: str) -> None:
        if self._is_counted and self._would_cover(line):
            self.clear()
        self._open()
        self._type(line)
        self._controller.tap("enter", on="chat")
        if self._is_counted:
            self._lines.note(line, self._clock.now())
        if self._timing.reads_chat:
            self._wait_until(lambda: not self._screen.is_chat_open(), "the chat did not close")
        else:
            self._controller.wait(self._timing.chat_close_s)

    def _would_cover(self, line: str) -> bool:
        """Return whether the line's answer would make the chat cover lines of the debug screen.

        The window's height is asked for only where the smallest window wouldn't have the room.
        """
        lines = self._lines.after(line, self._clock.now())
        if lines <= (chat_room(self._version) or 0):
            return False
        height = self._display.size()[1] // self._screen.gui_scale()
        return lines > (chat_room(self._version, height) or 0)

    def _close(self) -> None:
        """Close a chat that may be open: what is pressed next would be typed into it.

        Where none is open, Esc opens the Game Menu, and closes it again.
        """
        self._press_esc()
        if any(self._screen.menu().button(label).middle for label in LABELS["pause"]):
            self._press_esc()

    def _press_esc(self) -> None:
        self._controller.confirm_screen("menu")
        self._controller.tap("esc", on="menu")
        self._controller.wait(self._timing.chat_close_s)

    def _open(self) -> None:
        self._controller.tap(self._key)
        if self._timing.reads_chat:
            self._wait_until(self._is_empty, "the chat did not open, empty")
        else:
            self._controller.wait(self._timing.chat_open_s)

    def _is_empty(self) -> bool:
        """Return whether the line is seen open and empty. Where it holds something, a Backspace is pressed.

        A draft, which the game itself brings back, is gone with the first one (FACTS: The chat's line).
        """
        is_typed, is_open = not self._screen.is_typed(""), self._screen.is_chat_open()
        if is_typed and is_open:
            self._controller.confirm_screen("chat")
            self._controller.tap("backspace", on="chat")
        return is_open and not is_typed

    def _type(self, line: str) -> None:
        for first in range(0, len(line), LETTERS_PER_LOOK):
            # Looked at again and again: on a busy machine a line takes a while, and the chat may close.
            self._look(self._screen.is_chat_open, "the chat did not stay open")
            self._controller.type_line(line[first : first + LETTERS_PER_LOOK])
        self._look(lambda: self._screen.is_typed(line), f"{line!r} was not seen in the chat{_CHANGED}")

    def _look(self, is_so: Callable[[], bool], problem: str) -> None:
        """Confirm the chat once it looks as it should, now and for a press that comes late; a blind one at once."""
        if self._timing.reads_chat:
            self._wait_until(is_so, problem)
        self._controller.confirm_screen("chat", lambda: self._look(is_so, problem))

    def _wait_until(self, is_so: Callable[[], bool], problem: str) -> None:
        deadline = Deadline(self._clock, PATIENCE_S)
        while not is_so():
            if deadline.has_passed:
                raise NotConfirmedError(
                    f"{problem}: leave mouse and keys alone, and look whether the game allows chat, and whether "
                    "Options > Accessibility > Text Background is Chat; if it draws its chat elsewhere, set "
                    "reads_chat = false under [input] in the profile"
                )
            self._controller.wait(TYPING_LOOK_S)
