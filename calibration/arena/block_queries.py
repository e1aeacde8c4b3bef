"""Asks the game about blocks without changing any, by commands whose answer shows on the debug screen.

From 1.13 on a command can be conditional. Each query turns the player's view to one pitch if the condition holds and to
another if it doesn't. If neither happens, the game doesn't know the command, or the blocks aren't loaded. 1.12 can ask
about a single block only; for regions its chat shows how many blocks were compared (FACTS: Commands). Where 1.12 shows
no answer, the answer is unknown.
"""

from calibration.arena.look_around import ANGLE_TOLERANCE_DEG
from calibration.arena.plan import Box, box_text, volume
from calibration.command_console import CommandConsole
from mc_nested.live.model.reading import Block, Reading
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.game_screen import GameScreen

ANSWER_S = 0.8
"""How long an answer may take: a command is done within a tick or two, and seen a frame later."""

_FIRST_PITCH, _PITCHES = 20, 40
"""Answers turn the view down by whole degrees, from the first on, one after the other, so that each differs."""


class BlockQueries:
    """Each answer is True, False, or None if unknown.

    Args:
        console: sends the commands and watches the debug screen.
        profile: has the game's version.
        screen: reads the window.
        yaw: the direction in which the player keeps looking, in degrees.
    """

    def __init__(self, console: CommandConsole, profile: Profile, screen: GameScreen, yaw: float) -> None:
        self._console, self._screen, self._yaw = console, screen, yaw
        self._is_1_12 = profile.game.dialect == "1.12"
        self._reads_chat = profile.input.reads_chat
        self._queries_sent = 0

    def is_air(self, block: Block) -> bool | None:
        """Whether a block is air."""
        xyz = " ".join(map(str, block))
        if self._is_1_12:
            return True if self._turns_view(f"/execute @s ~ ~ ~ detect {xyz} minecraft:air 0") else None
        return self._if_or_unless(f"block {xyz} minecraft:air")

    def are_alike(self, box: Box, other: Block) -> bool | None:
        """Whether a box holds the same blocks as the box of its size whose lowest corner is ``other``."""
        xyz = " ".join(map(str, other))
        if not self._is_1_12:
            return self._if_or_unless(f"blocks {box_text(box)} {xyz} all")
        if not self._reads_chat:
            return None
        self._console.clear()
        self._console.send(f"/testforblocks {box_text(box)} {xyz}")
        answer = f"{volume(box)} blocks compared"
        seen = self._console.watch(lambda _: self._screen.position_of(answer) is not None, ANSWER_S)
        return True if seen else None

    def is_uniform(self, box: Box) -> bool | None:
        """Whether a flat box is all of one block: it equals itself shifted by one block, and so does its first row."""
        (x, y, z), (other_x, _, other_z) = box
        along = self.are_alike(((x, y, z), (other_x - 1, y, other_z)), (x + 1, y, z))
        return along and self.are_alike(((x, y, z), (x, y, other_z - 1)), (x, y, z + 1))

    def _if_or_unless(self, condition: str) -> bool | None:
        if self._turns_view(f"/execute if {condition} run"):
            return True
        return False if self._turns_view(f"/execute unless {condition} run") else None

    def _turns_view(self, prefix: str) -> bool:
        pitch = _FIRST_PITCH + self._queries_sent % _PITCHES
        self._queries_sent += 1
        self._console.send(f"{prefix} tp @s ~ ~ ~ {self._yaw:g} {pitch}")

        def is_turned(reading: Reading) -> bool:
            return reading.pitch is not None and abs(reading.pitch - pitch) <= ANGLE_TOLERANCE_DEG

        return self._console.watch(is_turned, ANSWER_S) is not None
