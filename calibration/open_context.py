"""Opens a CalibrationContext on a game's window.

A watchdog releases keys that are held too long; the panic key stops all input, and so does a free mouse in a corner.
"""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from calibration.context import CalibrationContext
from mc_nested.live.devices import Devices
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.opening import Opening
from mc_nested.live.profile.tables import Profile

OpenContext = Callable[[Profile], AbstractContextManager[CalibrationContext]]
"""Opens the context of a profile's window. When it ends, every key is released."""


def context_opener(opening: Opening, ask: Callable[[str], bool]) -> OpenContext:
    """Opens contexts as the opening says, whatever the profile; they ask the person through ``ask``.

    After a yes, the game is in front again. If the person doesn't return to it in time, asking raises NotInFrontError.
    """

    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        with opening.connection(profile) as window, window.connection as connection, window.guarded():
            asks = ask_in_terminal(ask, opening.say, connection.devices)
            yield CalibrationContext(connection, opening.say, asks)

    return opened


def ask_in_terminal(ask: Callable[[str], bool], say: Callable[[str], None], devices: Devices) -> Callable[[str], bool]:
    """Asks a question outside the game. After a yes, waits until the person has switched back to the game."""

    def ask_and_return(question: str) -> bool:
        is_yes = ask(question)
        if is_yes and not devices.display.is_in_front():
            say("Switch back to the game.")
            wait_for_front(devices)
        return is_yes

    return ask_and_return
