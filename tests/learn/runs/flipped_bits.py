"""Files with single flipped bits, and everything that is read back of a training's folder."""

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.errors import RunError
from mc_nested.learn.runs.run_folder import RunFolder

STRUCTURE = re.compile(rb"PK\x01\x02|PK\x03\x04|PK\x05\x06|\x93NUMPY")
"""Where a part of an archive of arrays begins: its directory, an entry, its end, an array's header."""

LENGTH = 64
"""Bytes after such a place at which bits are flipped."""


def flipped(whole: bytes, count: int, seed: int = 0) -> Iterator[bytes]:
    """Yield the file with one bit flipped, so many times: half of them anywhere, half of them in its structure."""
    random = np.random.default_rng(seed)
    begins = [found.start() for found in STRUCTURE.finditer(whole)] + [max(len(whole) - LENGTH, 0)]
    for number in range(count):
        at = int(random.integers(len(whole)))
        if number % 2:
            at = min(int(random.choice(begins) + random.integers(LENGTH)), len(whole) - 1)
        yield whole[:at] + bytes([whole[at] ^ 1 << int(random.integers(8))]) + whole[at + 1 :]


class Loaded:
    """Takes what a checkpoint gives a training, and keeps it."""

    def __init__(self) -> None:
        self.arrays: list[Arrays] = []

    def state(self) -> Arrays:
        return {}

    def marks(self) -> Arrays:
        return {}

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:  # noqa: ARG002
        return {}

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None:
        self.arrays = [dict(state), *journals]


def plain(arrays: Mapping[str, NDArray[Any]]) -> dict[str, Any]:
    return {name: (str(kept.dtype), kept.shape, kept.tobytes()) for name, kept in arrays.items()}


def read_back(path: Path) -> Any:
    """Return all that a resume or a play takes from a training's folder."""
    folder, loaded = RunFolder.open(path), Loaded()
    folder.checkpoint.load_into(loaded)
    game = folder.learnt_game(0)
    parts = [*loaded.arrays, folder.policies(), *([game] if game else [])]
    return folder.config.model_dump(), folder.wall_s_so_far(), [plain(part) for part in parts]


def taken_as_whole(path: Path, count: int, seed: int = 0) -> list[str]:
    """Return the files of a training's folder that load with other values than were saved after one flipped bit."""
    before = read_back(path)
    bad = []
    for file in sorted(path.rglob("*")):
        if file.suffix not in (".toml", ".json", ".npz"):
            continue
        whole = file.read_bytes()
        for damaged in flipped(whole, count, seed):
            file.write_bytes(damaged)
            try:
                if read_back(path) != before:
                    bad.append(f"{file.name}: other values")
            except RunError as error:
                if "\n" in str(error):
                    bad.append(f"{file.name}: several lines")
            except Exception as error:
                bad.append(f"{file.name}: {error!r}")
        file.write_bytes(whole)
    return bad
