"""Asking the game about blocks without touching any: by commands whose answer shows on the debug screen.

From 1.13 on a condition may run a command, so it is let turn the player's view: to one pitch if it holds, to another
unless it does. Where neither comes, the game doesn't know the command, or the place isn't loaded. 1.12 can do so for
one block; for regions its chat says how many were compared (FACTS: Commands). What 1.12 doesn't say, it doesn't tell.
"""

from calibration.arena.plan import Box, volume, words
from calibration.console import Console
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Block, Reading

ANSWER_S = 0.8
"""How long an answer may take: a command is done within a tick or two, and seen a frame later."""

TURNED = 0.2
"""Degrees that a view may be off what a command asked for."""

_FIRST_PITCH, _PITCHES = 20, 40
"""Whole degrees down that answers turn the view to, one after the other."""


class Questions:
    """Asks; each answer is True, False, or None where the game doesn't tell.

    Args:
        console: types, and watches.
        profile: says the version.
        screen: what is read on the window.
        yaw: the view that is kept meanwhile, in degrees.
    """

    def __init__(self, console: Console, profile: Profile, screen: GameScreen, yaw: float) -> None:
        self._console, self._screen, self._yaw = console, screen, yaw
        self._is_1_12 = profile.game.dialect == "1.12"
        self._reads_chat = profile.input.reads_chat
        self._asked = 0

    def is_air(self, block: Block) -> bool | None:
        """Whether a block is air."""
        place = " ".join(map(str, block))
        if self._is_1_12:
            return True if self._turns(f"/execute @s ~ ~ ~ detect {place} minecraft:air 0") else None
        return self._if_or_unless(f"block {place} minecraft:air")

    def are_alike(self, box: Box, other: Block) -> bool | None:
        """Whether a box holds the same blocks as the one of its size whose lowest corner is ``other``."""
        place = " ".join(map(str, other))
        if not self._is_1_12:
            return self._if_or_unless(f"blocks {words(box)} {place} all")
        if not self._reads_chat:
            return None
        self._console.clear()
        self._console.send(f"/testforblocks {words(box)} {place}")
        answer = f"{volume(box)} blocks compared"
        seen = self._console.watch(lambda _: self._screen.place_of(answer) is not None, ANSWER_S)
        return True if seen else None

    def is_uniform(self, box: Box) -> bool | None:
        """Whether a flat box is all of one block: it is like itself one block on, and so is its first row."""
        (x, y, z), (other_x, _, other_z) = box
        along = self.are_alike(((x, y, z), (other_x - 1, y, other_z)), (x + 1, y, z))
        return along and self.are_alike(((x, y, z), (x, y, other_z - 1)), (x, y, z + 1))

    def _if_or_unless(self, condition: str) -> bool | None:
        if self._turns(f"/execute if {condition} run"):
            return True
        return False if self._turns(f"/execute unless {condition} run") else None

    def _turns(self, prefix: str) -> bool:
        pitch = _FIRST_PITCH + self._asked % _PITCHES
        self._asked += 1
        self._console.send(f"{prefix} tp @s ~ ~ ~ {self._yaw:g} {pitch}")

        def is_turned(reading: Reading) -> bool:
            return reading.pitch is not None and abs(reading.pitch - pitch) <= TURNED

        return self._console.watch(is_turned, ANSWER_S) is not None
