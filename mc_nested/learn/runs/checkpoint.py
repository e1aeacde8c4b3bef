"""A training on disk: if the process is killed at any moment, the last save or the new one is there, whole.

``state.npz`` is rewritten at every save. What only grows (a replay's transitions, finished episodes) goes into a
journal, one more file per save, so that a save costs only what was added. Both hold NumPy arrays by name, and end with
the SHA-256 of all before it; the state knows that of each journal, so that one of another save isn't taken for its own.
"""

import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save

from mc_nested.arrays import Arrays
from mc_nested.atomic_file import atomic_write, remove_leftovers
from mc_nested.errors import RunError

FILE, WHOLE_JOURNAL = "state.npz", "journal.npz"

ABOUT = "about"
"""The array of the state's file that holds what it says of itself, as JSON."""

SEAL = "checksum"
"""The key of a JSON file that holds the fingerprint of the others."""

_EXPORTED = ("policies.", "runs.episodes", "runs.finished", "runs.demonstrated")
"""What an exported training keeps of its state."""

_CHECKSUM_BYTES, _AT_ONCE = hashlib.sha256().digest_size, 1 << 20

MOST_JOURNALS = 64
"""Journals kept side by side before they are merged into one."""


class _About(BaseModel):
    """What is trained, and the checksums of its journals, by name and in their order."""

    model_config = ConfigDict(strict=True)

    identity: str
    journals: dict[str, str]


class Journalled(Protocol):
    """A training that can be saved: its state, and what was added since some earlier marks."""

    def state(self) -> Arrays: ...

    def marks(self) -> Arrays:
        """Return the length of the journal now, for ``journal``."""

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """Return what was added since those marks; everything if there are none."""

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None: ...


class Checkpoint:
    """The folder that one training is saved to and loaded from.

    Args:
        folder: its path; made at the first save.
        identity: what is trained; a checkpoint with another identity is refused.
        remedy: what to do where it is damaged, for the error.
    """

    def __init__(
        self, folder: Path, identity: Mapping[str, Any], remedy: str = "bring back a whole copy, or train the run again"
    ) -> None:
        self._folder = folder
        self._remedy = remedy
        self.identity = fingerprint(identity)
        self._journals: dict[str, str] = {}
        self._next = 0
        self._marks: Arrays | None = None

    @property
    def file(self) -> Path:
        """The file of the state; its identity is inside."""
        return self._folder / FILE

    @property
    def weights(self) -> Path:
        """The file of an exported training, beside the folder: its networks alone."""
        return self._folder.with_name("model.safetensors")

    @property
    def exists(self) -> bool:
        """Whether anything was ever saved, that training can go on from."""
        return self.file.exists()

    def save(self, training: Journalled, finished: bool = False) -> None:
        """Save the training as it is now; OSError if the disk refuses, the last save is intact then.

        The files of a finished training don't depend on how often it was saved and resumed.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        merge = finished or len(self._journals) >= MOST_JOURNALS
        name = WHOLE_JOURNAL if finished else f"journal-{self._next:06d}.npz"
        written = self._write(name, training.journal(None if merge else self._marks))
        journals = {**({} if merge else self._journals), name: written}
        about = _About(identity=self.identity, journals=journals)
        self._write(FILE, {ABOUT: np.array(about.model_dump_json()), **training.state()})
        for old in self._journals:
            if old not in journals:
                (self._folder / old).unlink(missing_ok=True)
        self._journals, self._next, self._marks = journals, self._next + 1, training.marks()

    def state(self) -> Arrays:
        """Return the last saved state; RunError if it is gone, damaged or another training's.

        Of an exported training, what is left of it.
        """
        if not self.weights.is_file():
            return self._open()[1]
        try:
            with safe_open(self.weights, "numpy") as weights:
                self._check((weights.metadata() or {}).get("identity"), self.weights)
                return {name: weights.get_tensor(name) for name in weights.keys()}  # noqa: SIM118 - it is no mapping
        except (OSError, SafetensorError) as error:
            raise self._damaged(self.weights.absolute()) from error

    def export_to(self, other: "Checkpoint") -> None:
        """Save the networks that play, and how far they are, as another checkpoint's weights; RunError as ``state``."""
        kept = {name: each for name, each in self.state().items() if name.startswith(_EXPORTED)}
        other.weights.write_bytes(save(kept, {"identity": other.identity}))

    def load_into(self, training: Journalled) -> None:
        """Continue the training from its last save; RunError as for ``state``."""
        about, state = self._open()
        journals = [self._read(name, checksum) for name, checksum in about.journals.items()]
        try:
            training.load(state, journals)
        except (KeyError, IndexError, TypeError, ValueError) as error:
            raise self._damaged(FILE) from error
        remove_leftovers(self._folder)
        self._journals, self._marks = about.journals, training.marks()
        self._next = 1 + max((int(number) for name in self._journals if (number := name[8:-4]).isdigit()), default=-1)

    def _open(self) -> tuple[_About, Arrays]:
        if not self.exists:
            raise RunError(f"{self.file}: the checkpoint is gone: bring back a copy, or train again in a new folder")
        state = self._read(FILE)
        try:
            about = _About.model_validate_json(str(state.pop(ABOUT)))
        except (KeyError, ValueError) as error:
            raise self._damaged(FILE) from error
        self._check(about.identity, self.file)
        return about, state

    def _check(self, identity: str | None, file: Path) -> None:
        if identity != self.identity:
            raise RunError(
                f"{file}: the checkpoint belongs to another scenario, agent or preset than this run's "
                f"config.toml: put back the config.toml it was trained with"
            )

    def _write(self, name: str, arrays: Mapping[str, NDArray[Any]]) -> str:
        """Write a file, and return its checksum."""
        with atomic_write(self._folder / name) as path, path.open("wb+") as file:
            np.savez(file, allow_pickle=False, **arrays)
            file.seek(-2, os.SEEK_END)
            file.write(_CHECKSUM_BYTES.to_bytes(2, "little"))  # how long the archive's comment is, which follows
            checksum = _checksum_of(file, file.tell())
            file.write(checksum)
        return checksum.hex()

    def _read(self, name: str, expected: str | None = None) -> Arrays:
        """Return a file's arrays; RunError if it isn't as it was written, or hasn't the checksum that is expected."""
        try:
            with (self._folder / name).open("rb") as file:
                end = file.seek(-_CHECKSUM_BYTES, os.SEEK_END)
                checksum = file.read()
                if checksum != _checksum_of(file, end):
                    raise ValueError("another checksum")
                if expected not in (None, checksum.hex()):
                    raise RunError(f"{self._folder / name}: belongs to another save than {FILE}: {self._remedy}")
                file.seek(0)
                with np.load(file, allow_pickle=False) as arrays:
                    return dict(arrays)
        except (OSError, ValueError) as error:
            raise self._damaged(name) from error

    def _damaged(self, name: str | Path) -> RunError:
        return RunError(f"{self._folder / name}: the checkpoint is damaged or cut short: {self._remedy}")


def _checksum_of(file: BinaryIO, end: int) -> bytes:
    """Return the SHA-256 of a file's first ``end`` bytes, and leave the file there."""
    checksum = hashlib.sha256()
    file.seek(0)
    for begin in range(0, end, _AT_ONCE):
        checksum.update(file.read(min(_AT_ONCE, end - begin)))
    return checksum.digest()


def fingerprint(content: Mapping[str, Any]) -> str:
    """Return a hash of what can be JSON; it doesn't depend on the order of its keys."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def sealed(content: Mapping[str, Any]) -> str:
    """Return it as the JSON of a file that is read back, with its ``fingerprint``."""
    return json.dumps({**content, SEAL: fingerprint(content)}, indent=2) + "\n"


def unsealed(path: Path) -> dict[str, Any]:
    """Return what a file holds that ``sealed`` wrote; OSError or ValueError if it can't be read, or was changed."""
    content: dict[str, Any] = json.loads(path.read_text("utf-8"))
    if not isinstance(content, dict) or content.pop(SEAL, None) != fingerprint(content):
        raise ValueError("it was changed")
    return content
