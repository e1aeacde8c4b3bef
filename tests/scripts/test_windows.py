"""scripts/windows.py: its refusals, and its list of tests for Windows, which is complete."""

import os
import re
import sys
from pathlib import Path

import pytest

from scripts import windows
from scripts.programs import Program
from scripts.windows import WHERE_WINDOWS_DIFFERS

ROOT = Path(__file__).resolve().parents[2]
ASKS = re.compile(r"sys\.platform|os\.name\b|import ctypes")
ELSEWHERE = {
    "mc_nested/view/terminal_view.py": "its test has a terminal of Linux",
    "mc_nested/cli/training_end.py": "its test is of a Linux shell's quotes",
    "sim/window/glfw_window.py": "tests/windows/test_live_path.py plays in it",
}
"""Modules that ask the system for something, and have no tests of their own there."""


def test_another_operating_system_is_a_one_line_error_and_exit_code_2(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.platform", "darwin")
    assert windows.main(["setup"], tmp_path / "cache") == 2
    said = capsys.readouterr().err
    assert said.startswith("windows: Wine needs Linux")
    assert said.count("\n") == 1
    assert not (tmp_path / "cache").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="Linux without apt")
def test_without_apt_a_one_line_error_names_the_packages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", os.fspath(tmp_path))
    monkeypatch.setattr("scripts.windows_parts.WINE", windows_program("no-such-wine"))
    assert windows.main(["setup"], tmp_path / "cache") == 2
    said = capsys.readouterr().err
    assert said.startswith("windows: Wine needs programs that it can only get with apt")
    assert "no-such-wine" in said
    assert said.count("\n") == 1


def windows_program(name: str) -> Program:
    return Program((name,), name)


def place_of_tests(module: Path) -> Path:
    """Return where a module's tests are: their tree is that of the modules, without the package's own name."""
    parts = module.parts[1:] if module.parts[0] == "mc_nested" else module.parts
    return Path("tests", *parts[:-1], f"test_{module.name}")


def test_every_place_where_windows_differs_exists_and_has_a_reason() -> None:
    assert [place for place in WHERE_WINDOWS_DIFFERS if not (ROOT / place).exists()] == []
    assert all(WHERE_WINDOWS_DIFFERS.values())


def test_every_module_that_asks_for_the_system_is_tested_on_windows() -> None:
    files = [
        path.relative_to(ROOT) for top in ("mc_nested", "sim", "calibration") for path in (ROOT / top).rglob("*.py")
    ]
    ask = [path for path in files if ASKS.search((ROOT / path).read_text("utf-8"))]
    assert len(ask) > 10
    left_out = [
        path.as_posix()
        for path in ask
        if path.as_posix() not in ELSEWHERE
        and not any(place_of_tests(path).is_relative_to(place) for place in WHERE_WINDOWS_DIFFERS)
    ]
    assert left_out == []
