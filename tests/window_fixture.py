"""A display with a real window on it, for tests marked ``window`` (scripts/window_display.py)."""

from collections.abc import Iterator

import pytest

from scripts.window_display import install_programs, open_display
from tests.found_or_skipped import found_or_skipped


@pytest.fixture(scope="session")
def window_programs(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Install everything that a real window needs, or skip."""
    found_or_skipped(lambda: install_programs(print, tmp_path_factory.mktemp("apt") / "apt.log"))


@pytest.fixture
def display(window_programs: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - installs what is missing
    """Return the environment of programs on an empty display without a window manager."""
    with open_display() as env:
        yield env
