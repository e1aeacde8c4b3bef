"""The virtual client's world as a folder on disk, to test restoring a world by copying its folder."""

import gzip
import json
from pathlib import Path
from typing import Any

from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import VirtualWorld

LEVEL = "level.dat"


def write_world(realm: Realm, folder: Path) -> None:
    """Write the realm into a folder; other files there are left alone."""
    player, world = realm.player, realm.world
    level = {
        "floor": [world.floor, world.floor_block],
        "blocks": [[*block, name] for block, name in sorted(world.built().items())],
        "feet": player.feet,
        "view": [player.yaw, player.pitch],
        "mode": player.mode,
        "slot": player.slot,
        "hotbar": [stack and [stack.block, stack.count] for stack in player.hotbar],
        "rules": realm.rules,
        "day_time": realm.day_time,
    }
    folder.mkdir(parents=True, exist_ok=True)
    (folder / LEVEL).write_bytes(gzip.compress(json.dumps(level).encode(), mtime=0))


def read_world(realm: Realm, folder: Path) -> Realm:
    """The realm in a folder; what isn't saved, such as the version, is taken from ``realm``."""
    level: dict[str, Any] = json.loads(gzip.decompress((folder / LEVEL).read_bytes()))
    world = VirtualWorld(*level["floor"])
    world.restore({(x, y, z): name for x, y, z, name in level["blocks"]})
    player = Player(
        (level["feet"][0], level["feet"][1], level["feet"][2]),
        level["view"][0],
        level["view"][1],
        mode=level["mode"],
        slot=level["slot"],
        hotbar=[Stack(*stack) if stack else None for stack in level["hotbar"]],
    )
    return Realm(
        realm.edition,
        world,
        player,
        realm.player_name,
        realm.has_cheats,
        realm.spawn,
        level["rules"],
        level["day_time"],
    )
