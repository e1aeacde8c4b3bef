"""The player's eye between two ticks: pictures come more often than ticks."""

from sim.client.client import TICK_S
from sim.client.game.game import VirtualGame
from sim.client.game.view import Eye

_JUMP = 4.0
"""Blocks that nobody walks in a tick: a teleport, which is seen at once."""


class SmoothEye:
    """Follows a game's player; between two ticks it moves evenly from the last eye to the present one."""

    def __init__(self, game: VirtualGame) -> None:
        self._game = game
        self._ticks, self._since = game.ticks, 0.0
        self._before = self._now = game.realm.eye()

    def at(self, now: float) -> Eye:
        """The eye at a time of the client's clock, in seconds; times never go back."""
        game = self._game
        if game.ticks != self._ticks:
            self._ticks, self._since = game.ticks, now
            self._before, self._now = self._now, game.realm.eye()
            if max(abs(one - other) for one, other in zip(self._before, self._now, strict=True)) > _JUMP:
                self._before = self._now
        part = min(1.0, (now - self._since) / TICK_S)
        x, y, z = (one + (other - one) * part for one, other in zip(self._before, self._now, strict=True))
        return Eye((x, y, z), game.realm.player.yaw, game.realm.player.pitch)
