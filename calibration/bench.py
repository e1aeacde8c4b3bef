"""A bench over a game's window: its devices, and hands that a watchdog, a key and the screen's corners can stop."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

from calibration.step import Bench
from mc_nested.live.at_rest import wait_for_front
from mc_nested.live.desktop import open_desktop
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.watchdog import watched

BenchOf = Callable[[Profile], AbstractContextManager[Bench]]
"""Opens the bench of a profile's window; every key is up again when the context ends."""


def bench_for(say: Callable[[str], None], ask: Callable[[str], bool]) -> BenchOf:
    """Opens benches of this desktop whose person is told, and asked, by these; DesktopError without the window.

    After a yes the game is in front again; NotInFrontError, from the question, where it didn't get there.
    """

    @contextmanager
    def opened(profile: Profile) -> Iterator[Bench]:
        with open_desktop(profile.window.title) as desktop:
            # Imported here, since it needs the display that is open only now.
            from mc_nested.live.desktop.panic import open_panic_switch

            def ask_and_return(question: str) -> bool:
                # Whoever answers in a terminal has to come back to the game.
                is_yes = ask(question)
                if is_yes and not desktop.display.is_in_front():
                    say("Switch back to the game.")
                    wait_for_front(desktop.display, desktop.clock)
                return is_yes

            hands = Hands(desktop.display, desktop.keyboard, desktop.pointer, desktop.clock, profile.input)
            with hands, watched(hands), open_panic_switch(profile.keys.panic, hands.stop):
                yield Bench(desktop, hands, say, ask_and_return)

    return opened
