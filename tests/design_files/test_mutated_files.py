"""Ten thousand damaged files of every format: each is read or refused in one line, quickly, with little memory."""

import random
import re
import time
import tracemalloc
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from litemapy import Schematic

from mc_nested.design_files.load import load_any_scenario
from mc_nested.errors import ScenarioError
from tests.cli.running import run
from tests.design_files.mutations import mutated
from tests.design_files.other_readers import OtherReaders, other_readers
from tests.design_files.test_other_writers import filled
from tests.design_files.written import HUT, WRITERS, litematic, picture, region

__all__ = ["other_readers"]

pytestmark = pytest.mark.slow

MOST_S = 1.0
"""Seconds of processor time that a small file may take: a thousandth of that is usual."""

MOST_BYTES = 100 * 2**20
"""Bytes that reading a small file may allocate: what a file may unpack to, and a few copies of it."""


@pytest.fixture(autouse=True)
def _traced() -> Iterator[None]:
    tracemalloc.start()
    yield
    tracemalloc.stop()


def written_here(folder: Path) -> dict[str, bytes]:
    """Return small files that our tests write, and litemapy's."""
    files = {name: write(HUT) for name, write in WRITERS.items()}
    files["regions.litematic"] = litematic({"a": region(HUT), "b": region(HUT, (2, 1, -2), "y")})
    files |= {f"{mode}.png": picture(HUT[0], mode) for mode in ("RGBA", "P", "L", "1")}
    blocks, _ = filled((6, 3, 5), 20)
    Schematic(regions={"all": blocks}).save(str(folder / "litemapy.litematic"))
    blocks.to_structure_nbt().save(str(folder / "litemapy.nbt"))
    blocks.to_sponge_nbt().save(str(folder / "litemapy.schem"))
    return files | {path.name: path.read_bytes() for path in folder.glob("litemapy.*")}


def outcome(path: Path) -> str:
    """Read a file, and return what came of it: ``read``, or the kind of refusal. Anything but one line fails."""
    tracemalloc.reset_peak()
    before, began = tracemalloc.get_traced_memory()[0], time.process_time()
    try:
        loaded = load_any_scenario(path)
        said, found = [*loaded.notes, loaded.scenario.name], "read"
    except ScenarioError as error:
        said = [str(error)]
        found = re.sub(r"-?\d[\d,]*", "N", str(error).removeprefix(f"{path}: ").partition(":")[0])
    assert time.process_time() - began < MOST_S
    assert tracemalloc.get_traced_memory()[1] - before < MOST_BYTES
    assert all(line.isprintable() for line in said)
    return found


def outcomes(files: dict[str, bytes], count: int, seed: int, folder: Path) -> Counter[str]:
    """Return how often each outcome came of ``count`` damaged copies of the files, each file equally often."""
    generator = random.Random(seed)  # noqa: S311 - damage, no secret
    found: Counter[str] = Counter()
    names = sorted(files)
    for number in range(count):
        path = folder / f"damaged-{names[number % len(names)]}"
        path.write_bytes(mutated(files[path.name.removeprefix("damaged-")], generator))
        found[outcome(path)] += 1
    return found


def test_damaged_copies_of_small_files_are_read_or_refused_in_one_line(tmp_path: Path) -> None:
    found = outcomes(written_here(tmp_path), 9_000, 2026, tmp_path)
    assert found.total() == 9_000
    assert 200 < found["read"] < 4_500
    assert len(found) > 30  # kinds of refusals


def test_damaged_copies_of_real_files_are_read_or_refused_in_one_line(
    other_readers: OtherReaders, tmp_path: Path
) -> None:
    real = {path.name: path.read_bytes() for path in other_readers.real_files}
    found = outcomes(real, 1_000, 2027, tmp_path)
    assert found.total() == 1_000
    assert 20 < found["read"] < 500


def test_the_command_refuses_a_damaged_file_in_one_line_with_exit_code_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    generator = random.Random(2028)  # noqa: S311 - damage, no secret
    refused = 0
    for name, data in written_here(tmp_path).items():
        for _ in range(10):
            path = tmp_path / f"damaged-{name}"
            path.write_bytes(mutated(data, generator))
            if outcome(path) == "read":
                continue
            assert run("scenarios", path) == 2
            printed = capsys.readouterr()
            assert printed.out == ""
            assert printed.err.startswith(f"mc-nested: {path}: ")
            assert printed.err.count("\n") == 1
            refused += 1
    assert refused > 80
