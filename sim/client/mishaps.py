"""Mishaps in a game: each kind by name, planned for a time or drawn at random."""

from dataclasses import dataclass
from typing import Literal, Protocol, get_args

import numpy as np

from sim.client.desktop.clock import Event, VirtualClock
from sim.client.desktop.window import VirtualWindow
from sim.client.game.game import VirtualGame
from sim.client.settings import Size

Kind = Literal[
    "lost_focus",
    "pause",
    "chat",
    "inventory",
    "death",
    "disconnect",
    "frozen_frame",
    "black_frame",
    "lag",
    "dropped_key",
    "late_key",
    "f3_off",
    "moved_window",
    "resized_window",
    "knocked_away",
    "refused_placing",
    "ghost_block",
    "notices",
]
KINDS: tuple[Kind, ...] = get_args(Kind)
DRAWN: tuple[Kind, ...] = tuple(kind for kind in KINDS if kind not in ("ghost_block", "notices"))
"""Those drawn at random unless others are asked for. A ghost block appears and is then taken back; notices cover the
upper right for five seconds."""

SIZES: tuple[Size, ...] = ((854, 480), (1024, 768), (1280, 720))
"""What a window may be resized to."""

NOTICES = ("Move with W, A, S and D", "New Recipes Unlocked!", "Open your inventory", "Look around", "Find a tree")
NOTICED_S = 5.0
"""Seconds that a notice stays."""

_OF_THE_WORLD = frozenset(
    {"pause", "chat", "inventory", "death", "disconnect", "f3_off", "knocked_away", "refused_placing", "ghost_block"}
)


class ShownWindow(Protocol):
    """The client's window on its desktop: the virtual one, or a real one."""

    def set_front(self, *, is_in_front: bool) -> None: ...

    def resize(self, size: Size) -> None: ...

    def shift_window(self, right: int, down: int) -> None: ...


class MishapTarget(ShownWindow, Protocol):
    """A client that mishaps happen to."""

    clock: VirtualClock
    game: VirtualGame
    window: VirtualWindow

    def stall(self, seconds: float) -> None: ...

    def freeze(self, seconds: float) -> None: ...

    def blacken(self, seconds: float) -> None: ...


@dataclass(frozen=True)
class Mishap:
    """A mishap that happened, and when, in seconds."""

    kind: Kind
    at: float


class Mishaps:
    """Makes mishaps happen to a client, and records them in ``happened``.

    Args:
        client: what they happen to.
        rng: draws them.
        shown: the window that shows the client, where that is a real one: the desktop's part is done to it.
    """

    def __init__(self, client: MishapTarget, rng: np.random.Generator, shown: ShownWindow | None = None) -> None:
        self._client, self._rng, self._shown = client, rng, shown or client
        self.happened: list[Mishap] = []
        game, window = client.game, client.window
        self._effects: dict[Kind, Event] = {
            "lost_focus": self._lose_focus,
            "pause": lambda: game.open("pause"),
            "chat": lambda: game.open("chat"),
            "inventory": lambda: game.open("inventory"),
            "death": game.die,
            "disconnect": lambda: game.disconnect("Timed out"),
            "frozen_frame": lambda: client.freeze(self._between(0.1, 1.0)),
            "black_frame": lambda: client.blacken(self._between(0.05, 0.5)),
            "lag": lambda: client.stall(self._between(0.1, 1.0)),
            "dropped_key": window.drop_next,
            "late_key": lambda: window.delay_next(self._between(0.05, 0.3)),
            "f3_off": game.hide_f3,
            "moved_window": self._move_window,
            "resized_window": self._resize_window,
            "knocked_away": self._knock_away,
            "refused_placing": game.refuse_next,
            "ghost_block": game.expect_ghost,
            "notices": self._notice,
        }

    def plan(self, kind: Kind, in_s: float = 0.0) -> None:
        """Let a mishap happen so many seconds from now."""
        clock = self._client.clock
        clock.call_at(clock.now() + in_s, lambda: self._happen(kind))

    def maybe(self, rate: float, within_s: float, kinds: tuple[Kind, ...] = DRAWN) -> bool:
        """With probability ``rate``, plan one of these kinds within the next ``within_s``, and return whether it did.

        If this is called once before each action, ``rate`` is a rate per action.
        """
        if self._rng.random() >= rate:
            return False
        self.plan(self._drawn(kinds), float(self._rng.uniform(0, within_s)))
        return True

    def every(self, rate_per_s: float, kinds: tuple[Kind, ...] = DRAWN) -> None:
        """From now on, let mishaps happen at random, so many a second on average."""
        clock = self._client.clock

        def next_one() -> None:
            self._happen(self._drawn(kinds))
            clock.call_at(clock.now() + float(self._rng.exponential(1 / rate_per_s)), next_one)

        clock.call_at(clock.now() + float(self._rng.exponential(1 / rate_per_s)), next_one)

    def _happen(self, kind: Kind) -> None:
        """Make it happen. What happens in the world is left out while another screen is open."""
        if self._client.game.screen != "world" and kind in _OF_THE_WORLD:
            return
        self.happened.append(Mishap(kind, self._client.clock.now()))
        self._effects[kind]()

    def _lose_focus(self) -> None:
        clock, shown = self._client.clock, self._shown
        shown.set_front(is_in_front=False)
        clock.call_at(clock.now() + self._between(0.2, 2.0), lambda: shown.set_front(is_in_front=True))

    def _move_window(self) -> None:
        self._shown.shift_window(int(self._rng.integers(-200, 200)), int(self._rng.integers(-200, 200)))

    def _resize_window(self) -> None:
        others = [size for size in SIZES if size != self._client.window.size]
        self._shown.resize(others[int(self._rng.integers(len(others)))])

    def _notice(self) -> None:
        client = self._client
        client.game.notices = NOTICES
        client.clock.call_at(client.clock.now() + NOTICED_S, lambda: setattr(client.game, "notices", ()))

    def _knock_away(self) -> None:
        turn = self._between(0, 2 * np.pi)
        self._client.game.knock((0.4 * float(np.cos(turn)), 0.36, 0.4 * float(np.sin(turn))))

    def _drawn(self, kinds: tuple[Kind, ...]) -> Kind:
        return kinds[int(self._rng.integers(len(kinds)))]

    def _between(self, low: float, high: float) -> float:
        return float(self._rng.uniform(low, high))
