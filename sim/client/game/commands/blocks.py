"""Commands that change blocks: /fill and /setblock."""

from sim.client.game.commands.words import CommandRefusedError, block_name, block_position
from sim.client.game.realm import Realm

FILL_LIMIT = 32768


def fill(realm: Realm, words: list[str]) -> str:
    """``/fill x1 y1 z1 x2 y2 z2 block [keep]``; 1.12 has a number after the block. ``keep`` fills air alone."""
    low, high = block_position(realm, words[:3]), block_position(realm, words[3:6])
    name = block_name(realm, words[6])
    count = 1
    for one, other in zip(low, high, strict=True):
        count *= abs(one - other) + 1
    if count > FILL_LIMIT:
        raise CommandRefusedError(f"Too many blocks in the specified area (maximum {FILL_LIMIT}, specified {count})")
    edition = realm.edition
    modes = words[7:] if edition.since(1, 13) else words[8:]
    if modes not in ([], ["keep"]):
        raise ValueError(words)
    changed = realm.world.fill(low, high, name, only_air=modes == ["keep"])
    if not edition.since(1, 13):
        if not changed:
            raise CommandRefusedError("No blocks filled")
        return f"{changed} blocks filled"
    if not changed:
        raise CommandRefusedError("No blocks were filled")
    return f"Successfully filled {changed} {'block(s)' if edition.since(1, 20) else 'blocks'}"


def setblock(realm: Realm, words: list[str]) -> str:
    """``/setblock x y z block``."""
    x, y, z = block = block_position(realm, words[:3])
    new = realm.edition.since(1, 13)
    if not realm.world.put(block, block_name(realm, words[3])):
        raise CommandRefusedError("Could not set the block" if new else "The block couldn't be placed")
    return f"Changed the block at {x}, {y}, {z}" if new else "Block placed"
