"""The tests that run under Wine: they are there, and so are those of every module that asks on which system it runs."""

import re
from pathlib import Path

from scripts.windows_suite import WHERE_WINDOWS_DIFFERS

ROOT = Path(__file__).resolve().parents[2]
ASKS = re.compile(r"sys\.platform|os\.name\b|import ctypes")
ELSEWHERE = {
    "mc_nested/view/terminal_view.py": "its test has a terminal of Linux",
    "mc_nested/cli/training_end.py": "its test is of a Linux shell's quotes",
    "sim/window/glfw_window.py": "tests/windows/test_live_path.py plays in it",
}
"""Modules that ask, without tests of their own there."""


def place_of_tests(module: Path) -> Path:
    """Where a module's tests are: their tree is that of the modules, without the package's own name."""
    parts = module.parts[1:] if module.parts[0] == "mc_nested" else module.parts
    return Path("tests", *parts[:-1], f"test_{module.name}")


def test_every_place_is_there_with_its_reason() -> None:
    assert [place for place in WHERE_WINDOWS_DIFFERS if not (ROOT / place).exists()] == []
    assert all(WHERE_WINDOWS_DIFFERS.values())


def test_what_asks_on_which_system_it_runs_is_tested_on_windows() -> None:
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
