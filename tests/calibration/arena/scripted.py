"""A scripted console: it notes each command, and answers with the reading that a test's function returns."""

from collections.abc import Callable, Sequence

from calibration.arena.ground_survey import BlockQueries
from calibration.command_console import CommandConsole
from mc_nested.live.model.reading import Block, Reading
from mc_nested.live.profile.arena import Box


class ScriptedConsole(CommandConsole):
    """Each command leads to the reading that ``respond`` gives for it; without one the reading stays."""

    def __init__(self, respond: Callable[[str], Reading | None] = lambda _: None) -> None:
        self.sent: list[str] = []
        self.reading = Reading(xyz=(0.5, 64.0, 0.5), yaw=0.0, pitch=0.0)
        self._respond = respond

    def send(self, command: str) -> None:
        self.sent.append(command)
        self.reading = self._respond(command) or self.reading

    def read(self) -> Reading:
        return self.reading

    def watch(self, is_so: Callable[[Reading], bool], seconds: float) -> Reading | None:
        assert seconds > 0
        return self.reading if is_so(self.reading) else None

    def clear(self) -> None:
        self.sent.append("clear")


class ScriptedQueries(BlockQueries):
    """Answers from tables; what isn't in them is ``otherwise``."""

    def __init__(
        self,
        air: dict[Block, bool | None] | None = None,
        alike: dict[Block, bool | None] | None = None,
        *,
        uniform: bool | None = True,
        otherwise: bool | None = True,
    ) -> None:
        self._air, self._alike, self._uniform, self._otherwise = air or {}, alike or {}, uniform, otherwise
        self.compared: list[tuple[Box, Block]] = []

    def is_air(self, block: Block) -> bool | None:
        return self._air.get(block, self._otherwise)

    def are_alike(self, box: Box, other: Block) -> bool | None:
        self.compared.append((box, other))
        return self._alike.get(other, self._otherwise)

    def is_uniform(self, box: Box) -> bool | None:
        assert box[0][1] == box[1][1], "a floor is flat"
        return self._uniform


def looks(commands: Sequence[str]) -> list[str]:
    """Return the teleports among the commands."""
    return [command for command in commands if command.startswith("/tp")]
