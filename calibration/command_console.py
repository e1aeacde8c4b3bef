"""Sends commands through the chat of the visible world, and watches the debug screen for their effect on the player."""

from collections.abc import Callable

from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Deadline
from mc_nested.live.menus.chat import Chat
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.timing import TYPING_LOOK_S
from mc_nested.live.profile.tables import Profile


class CommandConsole:
    """Sends commands, and watches the debug screen for their effect.

    Raises (all methods): UnreadableError if the debug screen can't be read within the profile's patience;
    NotConfirmedError if the chat is open, or isn't seen as it should be; errors of the input controller.
    """

    def __init__(self, connection: GameConnection, profile: Profile) -> None:
        self._controller, self._clock = connection.controller, connection.devices.clock
        self._chat = Chat(profile, connection)
        self._profile, self._screen = profile, connection.screen

    def send(self, command: str) -> None:
        """Send a command."""
        self._check_in_world()
        self._chat.send(command)

    def read(self) -> Reading:
        """Read the debug screen; wait while it can't be read."""
        deadline = Deadline(self._clock, self._profile.body.patience_s)
        while (reading := self._screen.read()).xyz is None:
            self._controller.check_front()
            if deadline.has_passed:
                raise UnreadableError(f"the debug screen was unreadable for too long: {reading.problem}")
            self._controller.wait(TYPING_LOOK_S)
        return reading

    def watch(self, is_so: Callable[[Reading], bool], seconds: float) -> Reading | None:
        """Return the first reading within so many seconds for which ``is_so`` holds, or None."""
        deadline = Deadline(self._clock, seconds)
        while not is_so(reading := self.read()):
            if deadline.has_passed:
                return None
            self._controller.wait(TYPING_LOOK_S)
        return reading

    def clear(self) -> None:
        """Clear the chat."""
        self._check_in_world()
        self._chat.clear()
        self._check_in_world()

    def _check_in_world(self) -> None:
        self.read()
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone, and start again")
        self._controller.confirm_screen("world", self._check_in_world)
