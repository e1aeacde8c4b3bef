"""The world as it truly is, in a file that tests read: the client writes it, not the code under test."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mc_nested.atomic_file import atomic_write
from mc_nested.live.model.reading import Block
from sim.client.client import VirtualClient


class TruthFile:
    """One JSON object, written anew at each frame in which something has changed, before that frame is shown.

    ``screen``, ``feet`` (blocks), ``yaw`` and ``pitch`` (degrees), ``block_in_hand``, ``keys_down``, ``is_in_front``,
    and ``built``: x, y, z and the name of each block that differs from the bare floor.
    """

    def __init__(self, path: Path, client: VirtualClient) -> None:
        self._path, self._client = path, client
        self._seen: Mapping[Block, str] = {}
        self._built: list[list[int | str]] = []
        self._written: dict[str, Any] = {}

    def write(self) -> None:
        """Write it, unless nothing has changed but the time."""
        truth = {**truth_of(self._client), "built": self._listed(self._client.realm.world.seen())}
        if truth == self._written:
            return
        self._written = truth
        with atomic_write(self._path) as unfinished:
            unfinished.write_text(json.dumps(truth), encoding="utf-8")

    def _listed(self, built: Mapping[Block, str]) -> list[list[int | str]]:
        """Return each block's x, y, z and name, in order; the same list again for the same mapping."""
        if built is not self._seen:
            self._seen, self._built = built, [[*block, name] for block, name in sorted(built.items())]
        return self._built


def truth_of(client: VirtualClient) -> dict[str, Any]:
    """Return what the file holds, but for ``built``."""
    player = client.realm.player
    stack = player.hotbar[player.slot]
    return {
        "screen": client.game.screen,
        "feet": player.feet,
        "yaw": player.yaw,
        "pitch": player.pitch,
        "block_in_hand": stack.block if stack else None,
        "keys_down": sorted(client.game.keys.physical),
        "is_in_front": client.window.is_in_front,
    }
