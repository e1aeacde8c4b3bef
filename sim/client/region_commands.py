"""Commands that compare and copy regions of blocks, in the syntax of each version (FACTS: Commands)."""

import itertools
from collections.abc import Callable, Iterator

from mc_nested.live.reading import Block
from sim.client.realm import Realm
from sim.client.world import block_of

MOST_BLOCKS = 32768
CHUNK = 16

Run = Callable[[Realm, list[str]], str]


class Refused(Exception):  # noqa: N818 - no error of ours: the game's own answer
    """The game's answer to a command that can't be."""


def clone(realm: Realm, words: list[str]) -> str:
    """``/clone x1 y1 z1 x2 y2 z2 x y z``: copy a region to where its lowest corner is named."""
    low, high, other = _regions(realm, words)
    size = [high[axis] - low[axis] for axis in range(3)]
    if all(abs(low[axis] - other[axis]) <= size[axis] for axis in range(3)):
        raise Refused("The source and destination areas cannot overlap")
    copied = [(to, realm.world.block_at(block)) for block, to in _pairs(low, high, other)]
    count = sum(realm.world.put(to, name) for to, name in copied)
    new = realm.edition.since(1, 13)
    if not count:
        raise Refused("No blocks were cloned" if new else "No blocks cloned")
    return f"Successfully cloned {count} blocks" if new else f"{count} blocks cloned"


def testforblocks(realm: Realm, words: list[str]) -> str:
    """1.12: ``/testforblocks x1 y1 z1 x2 y2 z2 x y z``."""
    low, high, other = _regions(realm, words)
    if not _are_alike(realm, low, high, other):
        raise Refused("Source and destination are not identical")
    return f"{sum(1 for _ in _pairs(low, high, other))} blocks compared"


def execute(realm: Realm, words: list[str], run: Run, block_name: Callable[[Realm, str], str]) -> str:
    """A condition and the command that it allows; nothing is said where it doesn't.

    1.12: ``/execute @s ~ ~ ~ detect x y z block data command``; from 1.13 on ``/execute if|unless block x y z block run
    command`` and ``... blocks x1 y1 z1 x2 y2 z2 x y z all run command``.
    """
    if not realm.edition.since(1, 13):
        if words[0] != "@s" or words[4] != "detect":
            raise ValueError(words)
        if realm.world.block_at(_block(realm, words[5:8])) != block_name(realm, words[8]):
            raise Refused(f"Failed to execute '{' '.join(words[10:])}' as {realm.player_name}")
        return run(realm, words[10:])
    negated = {"if": False, "unless": True}[words[0]]
    if words[1] == "blocks":
        holds, rest = _are_alike(realm, *_regions(realm, words[2:11])), words[11:]
        if rest.pop(0) not in ("all", "masked"):
            raise ValueError(words)
    elif words[1] == "block":
        place = _block(realm, words[2:5])
        _check_loaded(realm, place)
        holds, rest = realm.world.block_at(place) == block_name(realm, words[5]), words[6:]
    else:
        raise ValueError(words)
    if rest[0] != "run":
        raise ValueError(words)
    return run(realm, rest[1:]) if holds != negated else ""


def _regions(realm: Realm, words: list[str]) -> tuple[Block, Block, Block]:
    one, two, other = (_block(realm, words[at : at + 3]) for at in (0, 3, 6))
    low = (min(one[0], two[0]), min(one[1], two[1]), min(one[2], two[2]))
    high = (max(one[0], two[0]), max(one[1], two[1]), max(one[2], two[2]))
    count = 1
    for axis in range(3):
        count *= high[axis] - low[axis] + 1
    if count > MOST_BLOCKS:
        raise Refused(f"Too many blocks in the specified area (maximum {MOST_BLOCKS}, specified {count})")
    for corner in (low, high, other, tuple(other[axis] + high[axis] - low[axis] for axis in range(3))):
        _check_loaded(realm, (corner[0], corner[1], corner[2]))
    return low, high, other


def _check_loaded(realm: Realm, block: Block) -> None:
    own = block_of(realm.player.feet)
    if any(abs(block[axis] // CHUNK - own[axis] // CHUNK) > realm.view_distance for axis in (0, 2)):
        raise Refused("That position is not loaded" if realm.edition.since(1, 13) else "Cannot access blocks there")


def _are_alike(realm: Realm, low: Block, high: Block, other: Block) -> bool:
    world = realm.world
    return all(world.block_at(block) == world.block_at(to) for block, to in _pairs(low, high, other))


def _pairs(low: Block, high: Block, other: Block) -> Iterator[tuple[Block, Block]]:
    sides = [range(high[axis] - low[axis] + 1) for axis in range(3)]
    for x, y, z in itertools.product(*sides):
        yield (low[0] + x, low[1] + y, low[2] + z), (other[0] + x, other[1] + y, other[2] + z)


def _block(realm: Realm, words: list[str]) -> Block:
    x, y, z = (
        own + int(word[1:] or 0) if word.startswith("~") else int(word)
        for word, own in zip(words, block_of(realm.player.feet), strict=True)
    )
    return x, y, z
