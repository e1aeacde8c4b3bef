"""A saved world, which commands can change: blocks, player, game rules; and its folder on disk."""

import gzip
import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from sim.client.game.edition import Edition
from sim.client.game.physics import AT_REST, Vector
from sim.client.game.world import VirtualWorld

Mode = Literal["creative", "survival"]

SLOTS = 9
STANDING = (1.8, 1.62)
"""Height of the player and of the eyes, in blocks (FACTS: Standing, looking, placing)."""


@dataclass(frozen=True)
class Stack:
    """Some blocks of one kind, the name without namespace."""

    block: str
    count: int


@dataclass
class Player:
    """The player: position, view, motion and hotbar, in blocks, degrees and blocks a tick."""

    feet: Vector
    yaw: float = 0.0
    pitch: float = 0.0
    velocity: Vector = AT_REST
    on_ground: bool = True
    is_sneaking: bool = False
    mode: Mode = "creative"
    slot: int = 0
    hotbar: list[Stack | None] = field(default_factory=lambda: [None] * SLOTS)

    def look(self, yaw: float, pitch: float) -> None:
        """Turn to a view in degrees; the pitch stops at straight up and down."""
        self.yaw, self.pitch = yaw, min(90.0, max(-90.0, pitch))

    def go_to(self, feet: Vector) -> None:
        """Put the player at a position at once, standing still."""
        self.feet, self.velocity = feet, AT_REST

    def use_one(self) -> None:
        """Remove one block from the hand; in creative mode it never runs out."""
        stack = self.hotbar[self.slot]
        if self.mode == "survival" and stack is not None:
            self.hotbar[self.slot] = Stack(stack.block, stack.count - 1) if stack.count > 1 else None


@dataclass
class Realm:
    """A world with its player and its rules. ``players`` are all in that world, this one too."""

    edition: Edition
    world: VirtualWorld
    player: Player
    player_name: str = "Player"
    has_cheats: bool = True
    spawn: Vector = (0.5, 64.0, 0.5)
    rules: dict[str, str] = field(default_factory=dict)
    day_time: int = 6000
    view_distance: int = 10
    """Chunks around the player's own that are loaded."""
    players: list[Player] = field(default_factory=list)

    def __post_init__(self) -> None:
        if not any(player is self.player for player in self.players):
            self.players.append(self.player)

    def others(self) -> list[Vector]:
        """Return where the feet of the other players are."""
        return [player.feet for player in self.players if player is not self.player]

    def rule(self, older: str, newer: str, default: bool) -> bool:
        """Return whether a rule is on, given its name before 1.21.11 and its name since (FACTS: Commands)."""
        return self.rules.get(newer if self.edition.since(1, 21, 11) else older, str(default).lower()) == "true"

    def size(self) -> tuple[float, float]:
        """Return the player's height and that of the eyes, in blocks."""
        return self.edition.sneaking_height() if self.player.is_sneaking else STANDING

    def eye(self) -> Vector:
        """Return the position that the player looks from."""
        x, y, z = self.player.feet
        return x, y + self.size()[1], z


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
    """Return the realm in a folder; what isn't saved, such as the version, is taken from ``realm``."""
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
