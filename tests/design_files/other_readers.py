"""Two other readers of schematics, fetched with npm when a test needs them, and the real files that come with one.

What was fetched stays in .standin/readers (0.5 GB). A machine without npm, or without its registry, skips the tests;
with CI set, that is a failure.
"""

import json
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from scripts.programs import ROOT
from scripts.standin_parts import NODE, install_locked
from tests.found_or_skipped import found_or_skipped

HERE = Path(__file__).resolve().parent / "node"


@dataclass(frozen=True)
class OtherReaders:
    """The readers in a node_modules folder."""

    modules: Path

    @property
    def real_files(self) -> list[Path]:
        """The schematics of prismarine-schematic's own tests."""
        return sorted((self.modules / "prismarine-schematic/test/schematics").iterdir())

    def read(self, reader: str, files: Sequence[Path], out: Path) -> list[tuple[list[int], list[str]]]:
        """Return each file's size, width, height and length, and the names of its blocks, in the order y, z, x."""
        command = [NODE.required(), str(HERE / "read_designs.cjs"), reader, str(out), *map(str, files)]
        done = subprocess.run(
            command, cwd=self.modules.parent, capture_output=True, text=True, timeout=300, check=False
        )
        assert done.returncode == 0, done.stderr
        return [(each["size"], each["names"]) for each in json.loads(out.read_text())]


@pytest.fixture(scope="session")
def other_readers() -> OtherReaders:
    """Return the readers, installed once."""
    cache = ROOT / ".standin"
    cache.mkdir(exist_ok=True)
    log = cache / "readers.log"
    return OtherReaders(found_or_skipped(lambda: install_locked("the readers", HERE, cache / "readers", print, log)))
