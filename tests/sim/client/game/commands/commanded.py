"""A realm to try commands on."""

from sim.client.game.commands.chat_line import run
from sim.client.game.edition import Edition
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld


def realm(version: str = "1.20.1") -> Realm:
    """Return a flat world; the player stands in the block 8, 64, 8."""
    return Realm(Edition(version), VirtualWorld(64, "dirt"), Player((8.5, 64.0, 8.5), 30.0, 10.0))


def answer_to(line: str, played: Realm) -> tuple[str, bool]:
    """Return the first line of the answer, and whether it is an error."""
    first = run(line, played)[0]
    return first.text, first.is_error
