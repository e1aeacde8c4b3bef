"""Compiled code is kept on disk, and is compiled again when any source file has changed."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from mc_nested.compiled import PACKAGE, ROOT, _imported_by, compiled, fingerprint_of

STEP_BY_HALF = """
import numpy as np
from mc_nested.compiled import compiled
from mc_nested.learn.half import half

@compiled(nogil=True)
def step(value):
    return value - half(value)

print(step(8.0), sum(step.stats.cache_hits.values()))
"""

HALF = """
from mc_nested.compiled import compiled

@compiled()
def half(value):
    return value * 0.5
"""

UPDATES = """
import numpy as np
from mc_nested.learn.dqn.compiled_engine.engine import CompiledEngine
from mc_nested.learn.dqn.engine import Batch, UpdateRule
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.states import StateSpace

space = StateSpace(np.array([[3, 3]]), actions=2)
sizes = space.network([4])
online = initial_parameters(sizes, np.random.default_rng(0))[None]
engine = CompiledEngine(space, sizes, UpdateRule(2, 1e-2, 3, 1.0), online)
ones = np.ones((1, 2), np.float32)
batch = Batch(np.array([[[1, 2]], [[2, 3]]]), np.array([[0, 1]]), ones, ones, ones > 1, ones)
for _ in range(5):
    engine.update(np.array([0]), batch)
print(engine.online.astype(np.float64).sum())
"""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Return a copy of the package, whose files a test may change."""
    shutil.copytree(ROOT / "mc_nested", tmp_path / "mc_nested", ignore=shutil.ignore_patterns("__pycache__"))
    return tmp_path / "mc_nested"


def run(copy: Path, code: str, cache: str = "cache") -> str:
    """Return what the code prints in a new process with that copy of the package."""
    script = copy.parent / "script.py"
    script.write_text(code)
    variables = {**os.environ, "PYTHONPATH": str(copy.parent), "NUMBA_CACHE_DIR": str(copy.parent / cache)}
    done = subprocess.run([sys.executable, script], env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_function_is_compiled_once_and_again_when_another_file_has_changed(copy: Path) -> None:
    half = copy / "learn/half.py"
    half.write_text(HALF)
    assert run(copy, STEP_BY_HALF) == "4.0 0"
    assert run(copy, STEP_BY_HALF) == "4.0 1", "the second process finds what the first has compiled"
    half.write_text(HALF.replace("0.5", "0.25"))
    assert run(copy, STEP_BY_HALF) == "6.0 0"


@pytest.mark.slow
def test_a_changed_adam_source_changes_the_computed_update(copy: Path) -> None:
    before = run(copy, UPDATES)
    assert run(copy, UPDATES) == before
    adam = copy / "learn/dqn/compiled_engine/adam.py"
    adam.write_text(adam.read_text().replace("BETA_1, BETA_2, EPSILON = 0.9", "BETA_1, BETA_2, EPSILON = 0.1"))
    after = run(copy, UPDATES)
    assert after != before
    assert after == run(copy, UPDATES, "another cache")


def test_a_fingerprint_changes_with_every_imported_file(tmp_path: Path) -> None:
    def fingerprint() -> str:
        fingerprint_of.cache_clear()
        return fingerprint_of(tmp_path / "made/a.py", tmp_path, "made")

    (tmp_path / "made/inner").mkdir(parents=True)
    files = {
        "made/a.py": "import numpy\nfrom made.inner import (\n    b,\n)\n",
        "made/inner/__init__.py": "",
        "made/inner/b.py": "import made.c as c\n",
        "made/c.py": "from made.a import nothing\nCONSTANT = 1\n",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    seen = {fingerprint()}
    for name, text in files.items():
        (tmp_path / name).write_text(text + "# changed\n")
        seen.add(fingerprint())
    assert len(seen) == 1 + len(files)
    (tmp_path / "made/d.py").write_text("not imported")
    assert fingerprint() in seen


def test_packages_installed_beside_the_project_do_not_count(tmp_path: Path) -> None:
    for package, text in (("made", "import numba\nfrom numba import njit\n"), ("numba", "njit = 1\n")):
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text(text)
    source = tmp_path / "made/__init__.py"
    assert _imported_by(source, tmp_path, "made") == set()
    assert _imported_by(source, tmp_path, "numba") == {tmp_path / "numba/__init__.py"}


def test_the_engines_imports_include_adam_but_not_the_trainer() -> None:
    needed: set[Path] = set()
    new = {ROOT / "mc_nested/learn/dqn/compiled_engine/engine.py"}
    while new:
        needed |= new
        new = {path for source in new for path in _imported_by(source, ROOT, PACKAGE)} - needed
    names = {path.name for path in needed}
    assert {"adam.py", "networks.py", "self_imitation.py"} < names
    assert "trainer.py" not in names


def test_nothing_is_compiled_by_numbas_own_decorator() -> None:
    used = [path for path in (ROOT / "mc_nested").rglob("*.py") if "njit" in path.read_text("utf-8")]
    assert [path.name for path in used] == ["compiled.py"]


def test_a_compiled_function_takes_its_own_flags() -> None:
    @compiled(fused=True, nogil=True)
    def doubled(values: np.ndarray) -> np.ndarray:
        return values * 2

    assert doubled(np.ones(2)).tolist() == [2.0, 2.0]
    flags = doubled.targetoptions  # type: ignore[attr-defined]  # a dispatcher's
    assert (flags["fastmath"], flags["nogil"], flags["error_model"]) == ({"contract"}, True, "numpy")


PAIR = """
from typing import NamedTuple

class Pair(NamedTuple):
    first: float
    second: float
"""

SUM = """
from mc_nested.compiled import compiled
from mc_nested.learn.{module} import Pair

@compiled()
def both(pair):
    return pair.first + pair.second

print(both(Pair(1.0, 2.0)), sum(both.stats.cache_hits.values()))
"""


def test_a_function_is_compiled_again_after_the_file_of_its_arguments_class_was_renamed(copy: Path) -> None:
    (copy / "learn" / "pair.py").write_text(PAIR)
    assert [run(copy, SUM.format(module="pair")) for _ in range(2)] == ["3.0 0", "3.0 1"]
    (copy / "learn" / "pair.py").rename(copy / "learn" / "two.py")
    assert [run(copy, SUM.format(module="two")) for _ in range(2)] == ["3.0 0", "3.0 1"]
