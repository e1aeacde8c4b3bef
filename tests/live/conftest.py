"""Fixtures that the tests of the real devices share: an X server of their own."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from scripts.window_display import running
from tests.standin_fixture import Standin


@contextmanager
def _x_screen() -> Iterator[dict[str, str]]:
    """Yield the environment of an empty X screen of 1024 x 768, whose server ends with the context."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"]
    with os.fdopen(read) as numbers, running(command, keep=(write,)):
        os.close(write)
        yield {**os.environ, "DISPLAY": f":{numbers.readline().strip()}"}


@pytest.fixture
def x_server(standin: Standin) -> Iterator[dict[str, str]]:  # noqa: ARG001 - where the stand-in is up, there is an Xvfb
    """Return the environment of an empty X screen of 1024 x 768."""
    with _x_screen() as environment:
        yield environment


@pytest.fixture
def x_screen(window_programs: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - installs what is missing
    """Return the same, without the stand-in."""
    with _x_screen() as environment:
        yield environment
