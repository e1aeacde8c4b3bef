"""Every test has a limit; one that hangs is ended and named, and those after it are still run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import tomlkit

from tests.time_limits import LIMITS_S, UNIT_S, limit_s

ROOT = Path(__file__).resolve().parents[1]

CONFTEST = """
import pytest
from tests import time_limits

time_limits.UNIT_S, time_limits.LIMITS_S["slow"] = 0.5, 30.0


def pytest_collection_modifyitems(items):
    for item in items:
        time_limits.bound(item)
"""

HANGING = """
import threading, time

import pytest
from hypothesis import given, strategies as st


def test_that_waits_for_nothing():
    threading.Event().wait()


@given(st.integers())
def test_that_never_ends_an_example(number):
    while True:
        time.sleep(0.01)


@pytest.mark.slow
def test_that_may_take_longer():
    time.sleep(0.6)


@pytest.mark.timeout(20)
def test_with_a_limit_of_its_own():
    time.sleep(0.6)


def test_afterwards():
    pass
"""


def test_every_kind_of_test_has_a_limit() -> None:
    options = tomlkit.parse((ROOT / "pyproject.toml").read_text("utf-8")).unwrap()["tool"]["pytest"]["ini_options"]
    assert LIMITS_S.keys() == {marker.partition(":")[0] for marker in options["markers"]}
    assert all(0 < seconds < 3601 for seconds in (UNIT_S, *LIMITS_S.values()))


@pytest.mark.parametrize(
    ("markers", "longest"), [(set(), UNIT_S), ({"skipif"}, UNIT_S), ({"slow", "wine", "skipif"}, LIMITS_S["wine"])]
)
def test_a_test_of_two_kinds_has_the_longer_ones_limit(markers: set[str], longest: float) -> None:
    assert limit_s(markers) == longest


@pytest.mark.parametrize("kind", LIMITS_S)
def test_each_kind_of_test_has_its_own_limit(kind: str) -> None:
    assert limit_s({kind}) == LIMITS_S[kind]


def test_this_test_has_a_limit(request: pytest.FixtureRequest) -> None:
    pytest.importorskip("pytest_timeout", reason="not there under Wine")
    marker = request.node.get_closest_marker("timeout")
    assert marker is not None
    assert marker.args == (UNIT_S,)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there, no test fails by a signal: the first that hangs ends all")
def test_a_hanging_test_is_ended_and_named_and_later_tests_still_run(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text(CONFTEST)
    (tmp_path / "test_made.py").write_text(HANGING)
    (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers = slow\n")
    command = [sys.executable, "-m", "pytest", "-n", "1", "-q", "-p", "no:cacheprovider", "-rA"]
    done = subprocess.run(
        command,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTEST_ADDOPTS": ""},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    said = {line for line in done.stdout.splitlines() if line.startswith(("PASSED", "FAILED"))}
    assert "3 passed" in done.stdout, done.stdout
    assert "2 failed" in done.stdout, done.stdout
    assert {line.split()[1] for line in said if line.startswith("FAILED")} == {
        "test_made.py::test_that_waits_for_nothing",
        "test_made.py::test_that_never_ends_an_example",
    }
    assert "Timeout (>0.5s) from pytest-timeout" in done.stdout
    assert "crashed while running 'test_made.py::test_that_never_ends_an_example'" in done.stdout
