"""A display with a real window on it, for tests marked ``window`` (scripts/window_display.py)."""

import os
from collections.abc import Iterator

import pytest

from scripts.standin_parts import MissingError
from scripts.window_display import install_programs, open_display


@pytest.fixture(scope="session")
def window_programs(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Everything that a real window needs is installed.

    A machine where that is impossible skips the test and says how to get it; with CI set, that is a failure.
    """
    try:
        install_programs(print, tmp_path_factory.mktemp("apt") / "apt.log")
    except MissingError as error:
        if os.environ.get("CI"):
            pytest.fail(str(error))
        pytest.skip(str(error))


@pytest.fixture
def display(window_programs: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - installs what is missing
    """The environment of programs on an empty display without a window manager."""
    with open_display() as env:
        yield env
