"""Pictures of the real game that a user has, and what they show, as a file of truths says it.

``MC_NESTED_SCREENSHOTS`` names a folder with ``truth.jsonl``, a line a picture: ``file`` and ``font`` (paths from the
folder), ``xyz``, ``yaw``, ``pitch``, and ``target`` as ``{"pos": [x, y, z], "id": "minecraft:stone"}`` or null.
"""

import dataclasses
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.read_pictures import read_picture

VARIABLE = "MC_NESTED_SCREENSHOTS"
TRUTH = "truth.jsonl"

_SAID = ("xyz", "yaw", "pitch", "target")


def truths(folder: Path) -> list[dict[str, Any]]:
    """Return the lines of the folder's file of truths.

    Raises:
        ValueError: there is no such file, it has no line, or one lacks a key; the message says which.
    """
    path = folder / TRUTH
    if not path.is_file():
        raise ValueError(f"{VARIABLE}: there is no {path}: write it, a line a picture")
    lines = [json.loads(line) for line in path.read_text("utf-8").splitlines() if line.strip()]
    if not lines:
        raise ValueError(f"{path} has no line: write one a picture")
    for number, line in enumerate(lines, 1):
        if missing := {"file", "font", *_SAID} - line.keys():
            raise ValueError(f"{path}, line {number}: lacks {', '.join(sorted(missing))}")
    return lines


def differences(folder: Path, truth: dict[str, Any]) -> Iterator[str]:
    """Return where the reading of one picture differs from its truth, a line each."""
    found = read_picture(folder / truth["file"], load_font(folder / truth["font"]))
    read = json.loads(json.dumps(dataclasses.asdict(found), default=str))
    for key in _SAID:
        if read[key] != truth[key]:
            yield f"{truth['file']}: {key} is {truth[key]}, and was read as {read[key]} ({read['problem']})"
