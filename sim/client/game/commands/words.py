"""The words of a command: positions, blocks and players, as the game reads them (FACTS: Commands)."""

import re

from mc_nested.live.model.reading import Block
from sim.client.game.realm import Realm
from sim.client.game.world import AIR, block_of

_SELF = ("@s", "@p", "@a")
_BEFORE_1_13 = {"planks", "grass", "wool", "log"}
_SINCE_1_13 = {"oak_planks", "birch_planks", "grass_block", "white_wool", "oak_log", "smooth_stone"}
_ALWAYS = {AIR, "stone", "dirt", "cobblestone", "glass", "sand", "bedrock", "tnt", "obsidian", "lapis_block"}


class CommandRefusedError(Exception):
    """The game refuses a command that it understands; the message is its answer."""


def after_player(realm: Realm, words: list[str]) -> list[str]:
    """Return the words after the first one, which must name the only player."""
    if words[0] not in (*_SELF, realm.player_name):
        raise CommandRefusedError("No player was found")
    return words[1:]


def coordinate(word: str, own: float, *, centred: bool = False) -> float:
    """Return a coordinate or an angle; ``~`` is relative to ``own``."""
    if word.startswith("~"):
        return own + float(word[1:] or 0)
    # A whole number is moved to the block's middle, except for the height (FACTS: Commands).
    return float(word) + (0.5 if centred and re.fullmatch(r"-?\d+", word) else 0.0)


def block_position(realm: Realm, words: list[str]) -> Block:
    """Return the block that three words name; ``~`` is relative to the player's."""
    x, y, z = (
        own + int(word[1:] or 0) if word.startswith("~") else int(word)
        for word, own in zip(words, block_of(realm.player.feet), strict=True)
    )
    return x, y, z


def block_name(realm: Realm, word: str) -> str:
    """Return the block's name without namespace, if this version has such a block."""
    name = word.removeprefix("minecraft:")
    if name not in _ALWAYS | (_SINCE_1_13 if realm.edition.since(1, 13) else _BEFORE_1_13):
        raise CommandRefusedError(f"Unknown block type '{word}'")
    return name


def display_name(block: str) -> str:
    """Return a block's name as answers show it."""
    return {"planks": "Oak Wood Planks"}.get(block, block.replace("_", " ").title())
