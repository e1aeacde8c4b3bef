"""What goes wrong in a game: each kind by name, planned for a time or drawn at random."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

if TYPE_CHECKING:
    from sim.client.client import VirtualClient

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
]
KINDS: tuple[Kind, ...] = get_args(Kind)
DRAWN: tuple[Kind, ...] = tuple(kind for kind in KINDS if kind != "ghost_block")
"""Those that are drawn at random unless others are asked for; a ghost is a block that is seen and then taken back."""

SIZES = ((854, 480), (1024, 768), (1280, 720))
"""What a window may be resized to."""


@dataclass(frozen=True)
class Mishap:
    """A mishap that happened, and when, in seconds."""

    kind: Kind
    at: float


class Mishaps:
    """Makes mishaps happen to a client, and keeps account of them."""

    def __init__(self, client: "VirtualClient", rng: np.random.Generator) -> None:
        self._client, self._rng = client, rng
        self.happened: list[Mishap] = []

    def plan(self, kind: Kind, in_s: float = 0.0) -> None:
        """Let a mishap happen so many seconds from now."""
        clock = self._client.clock
        clock.call_at(clock.now() + in_s, lambda: self._happen(kind))

    def maybe(self, rate: float, within_s: float, kinds: tuple[Kind, ...] = DRAWN) -> bool:
        """With probability ``rate``, plan one of these kinds for a moment of the next ``within_s``; whether so.

        Asked once before each action, ``rate`` is a rate an action.
        """
        if self._rng.random() >= rate:
            return False
        self.plan(kinds[int(self._rng.integers(len(kinds)))], float(self._rng.uniform(0, within_s)))
        return True

    def every(self, rate_per_s: float, kinds: tuple[Kind, ...] = DRAWN) -> None:
        """From now on, let mishaps happen at random, so many a second on average."""
        clock = self._client.clock

        def next_one() -> None:
            self._happen(kinds[int(self._rng.integers(len(kinds)))])
            clock.call_at(clock.now() + float(self._rng.exponential(1 / rate_per_s)), next_one)

        clock.call_at(clock.now() + float(self._rng.exponential(1 / rate_per_s)), next_one)

    def _happen(self, kind: Kind) -> None:
        """Do it, unless it can't be: what happens in the world happens only while that is on the screen."""
        client, game = self._client, self._client.game
        if game.screen != "world" and kind in _OF_THE_WORLD:
            return
        self.happened.append(Mishap(kind, client.clock.now()))
        if kind == "lost_focus":
            client.set_front(is_in_front=False)
            client.clock.call_at(
                client.clock.now() + self._between(0.2, 2.0), lambda: client.set_front(is_in_front=True)
            )
        elif kind in ("pause", "chat", "inventory"):
            game.open(kind)
        elif kind == "death":
            game.die()
        elif kind == "disconnect":
            game.disconnect("Timed out")
        elif kind == "frozen_frame":
            client.freeze(self._between(0.1, 1.0))
        elif kind == "black_frame":
            client.blacken(self._between(0.05, 0.5))
        elif kind == "lag":
            client.stall(self._between(0.1, 1.0))
        elif kind == "dropped_key":
            client.window.to_drop += 1
        elif kind == "late_key":
            client.window.next_late_s = self._between(0.05, 0.3)
        elif kind == "f3_off":
            game.has_f3 = False
        elif kind == "moved_window":
            client.shift_window(int(self._rng.integers(-200, 200)), int(self._rng.integers(-200, 200)))
        elif kind == "resized_window":
            others = [size for size in SIZES if size != client.window.size]
            client.resize(others[int(self._rng.integers(len(others)))])
        elif kind == "knocked_away":
            turn = self._between(0, 2 * np.pi)
            game.knock((0.4 * float(np.cos(turn)), 0.36, 0.4 * float(np.sin(turn))))
        elif kind == "refused_placing":
            game.refusals += 1
        else:
            game.expect_ghost()

    def _between(self, low: float, high: float) -> float:
        return float(self._rng.uniform(low, high))


_OF_THE_WORLD = frozenset(
    {"pause", "chat", "inventory", "death", "disconnect", "f3_off", "knocked_away", "refused_placing", "ghost_block"}
)
