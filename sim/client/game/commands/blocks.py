"""Commands that change, compare and copy blocks: /fill, /setblock, /clone and others (FACTS: Commands)."""

import itertools
import math
from collections.abc import Callable, Iterator

from mc_nested.live.model.reading import Block
from sim.client.game.commands.words import CommandRefusedError, block_name, block_position
from sim.client.game.realm import Realm
from sim.client.game.world import block_of

MOST_BLOCKS = 32768
CHUNK = 16

Run = Callable[[Realm, list[str]], str]
"""Carries out the words of a command."""


def fill(realm: Realm, words: list[str]) -> str:
    """Do ``/fill x1 y1 z1 x2 y2 z2 block [keep]``; 1.12 has a number after the block. ``keep`` fills only air."""
    low, high = block_position(realm, words[:3]), block_position(realm, words[3:6])
    name = block_name(realm, words[6])
    _check_count(low, high)
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


def clone(realm: Realm, words: list[str]) -> str:
    """Do ``/clone x1 y1 z1 x2 y2 z2 x y z``: copy a region; x y z is the lowest corner of the copy."""
    low, high, other = _regions(realm, words)
    size = [high[axis] - low[axis] for axis in range(3)]
    if all(abs(low[axis] - other[axis]) <= size[axis] for axis in range(3)):
        raise CommandRefusedError("The source and destination areas cannot overlap")
    copied = [(to, realm.world.block_at(block)) for block, to in _pairs(low, high, other)]
    count = sum(realm.world.put(to, name) for to, name in copied)
    new = realm.edition.since(1, 13)
    if not count:
        raise CommandRefusedError("No blocks were cloned" if new else "No blocks cloned")
    return f"Successfully cloned {count} blocks" if new else f"{count} blocks cloned"


def testforblocks(realm: Realm, words: list[str]) -> str:
    """Do 1.12's ``/testforblocks x1 y1 z1 x2 y2 z2 x y z``."""
    low, high, other = _regions(realm, words)
    if not _are_alike(realm, low, high, other):
        raise CommandRefusedError("Source and destination are not identical")
    return f"{sum(1 for _ in _pairs(low, high, other))} blocks compared"


def execute(realm: Realm, words: list[str], run: Run) -> str:
    """Run a command on a condition; where that doesn't hold, there is no answer.

    1.12: ``/execute @s ~ ~ ~ detect x y z block data command``; from 1.13 on ``/execute if|unless block x y z block run
    command`` and ``... blocks x1 y1 z1 x2 y2 z2 x y z all run command``.
    """
    if not realm.edition.since(1, 13):
        if words[0] != "@s" or words[4] != "detect":
            raise ValueError(words)
        if realm.world.block_at(block_position(realm, words[5:8])) != block_name(realm, words[8]):
            raise CommandRefusedError(f"Failed to execute '{' '.join(words[10:])}' as {realm.player_name}")
        return run(realm, words[10:])
    negated = {"if": False, "unless": True}[words[0]]
    holds, rest = _condition(realm, words[1:])
    if rest[0] != "run":
        raise ValueError(words)
    return run(realm, rest[1:]) if holds != negated else ""


def _condition(realm: Realm, words: list[str]) -> tuple[bool, list[str]]:
    """Return whether a condition on blocks holds, and the words after it."""
    if words[0] == "blocks":
        holds = _are_alike(realm, *_regions(realm, words[1:10]))
        if words[10] not in ("all", "masked"):
            raise ValueError(words)
        return holds, words[11:]
    if words[0] == "block":
        block = block_position(realm, words[1:4])
        _check_loaded(realm, block)
        return realm.world.block_at(block) == block_name(realm, words[4]), words[5:]
    raise ValueError(words)


def _regions(realm: Realm, words: list[str]) -> tuple[Block, Block, Block]:
    """Return the lowest and highest corner of one region, and the lowest of another of the same size."""
    one, two, other = (block_position(realm, words[first : first + 3]) for first in (0, 3, 6))
    low = (min(one[0], two[0]), min(one[1], two[1]), min(one[2], two[2]))
    high = (max(one[0], two[0]), max(one[1], two[1]), max(one[2], two[2]))
    _check_count(low, high)
    for corner in (low, high, other, tuple(other[axis] + high[axis] - low[axis] for axis in range(3))):
        _check_loaded(realm, (corner[0], corner[1], corner[2]))
    return low, high, other


def _check_count(one: Block, other: Block) -> None:
    count = math.prod(abs(here - there) + 1 for here, there in zip(one, other, strict=True))
    if count > MOST_BLOCKS:
        raise CommandRefusedError(f"Too many blocks in the specified area (maximum {MOST_BLOCKS}, specified {count})")


def _check_loaded(realm: Realm, block: Block) -> None:
    own = block_of(realm.player.feet)
    if any(abs(block[axis] // CHUNK - own[axis] // CHUNK) > realm.view_distance for axis in (0, 2)):
        new = realm.edition.since(1, 13)
        raise CommandRefusedError("That position is not loaded" if new else "Cannot access blocks there")


def _are_alike(realm: Realm, low: Block, high: Block, other: Block) -> bool:
    world = realm.world
    return all(world.block_at(block) == world.block_at(to) for block, to in _pairs(low, high, other))


def _pairs(low: Block, high: Block, other: Block) -> Iterator[tuple[Block, Block]]:
    sides = [range(high[axis] - low[axis] + 1) for axis in range(3)]
    for x, y, z in itertools.product(*sides):
        yield (low[0] + x, low[1] + y, low[2] + z), (other[0] + x, other[1] + y, other[2] + z)
