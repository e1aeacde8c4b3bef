"""The world as it truly is, in a file that tests read: the client writes it, not the code under test."""

import json
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from sim.client.client import VirtualClient


class TruthFile:
    """One JSON object, written anew at each frame in which something has changed, before that frame is shown.

    ``screen``, ``feet`` (blocks), ``yaw`` and ``pitch`` (degrees), ``block_in_hand``, ``keys_down``, ``is_in_front``,
    and ``built``: x, y, z and the name of each block that differs from the bare floor.
    """

    def __init__(self, path: Path, client: VirtualClient) -> None:
        self._path, self._client = path, client
        self._written = ""

    def write(self) -> None:
        """Write it, unless nothing has changed but the time."""
        text = self._text()
        if text == self._written:
            return
        self._written = text
        with atomic_write(self._path) as unfinished:
            unfinished.write_text(text, encoding="utf-8")

    def _text(self) -> str:
        client, player = self._client, self._client.realm.player
        stack = player.hotbar[player.slot]
        return json.dumps(
            {
                "screen": client.game.screen,
                "feet": player.feet,
                "yaw": player.yaw,
                "pitch": player.pitch,
                "block_in_hand": stack.block if stack else None,
                "built": [[*block, name] for block, name in sorted(client.built.items())],
                "keys_down": sorted(client.game.keys.physical),
                "is_in_front": client.window.is_in_front,
            }
        )
