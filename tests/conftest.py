"""Fixtures and settings that several folders of tests share."""

import os
import signal
import sys
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

from tests.live.vision.real_pictures import VARIABLE
from tests.standin_fixture import standin
from tests.time_limits import bound
from tests.window_fixture import display, window_programs
from tests.windows_fixture import windows

__all__ = ["display", "standin", "window_programs", "windows"]

# Hypothesis tries few examples every day, and many with pytest --hypothesis-profile=all, which pytest-xdist's processes
# are told, too: they get the command's options. No test has a number of its own unless a reason stands beside it.
# How long an example takes says something of the machine, not of the code.
for profile, examples in (("everyday", 15), ("all", 100)):
    settings.register_profile(
        profile, max_examples=examples, deadline=None, suppress_health_check=[HealthCheck.too_slow]
    )
settings.load_profile("everyday")

# Containers often tell Python to keep no bytecode, so that images stay small. Here, each of pytest-xdist's processes
# would compile every test anew, in ten seconds, and each program that a test starts the whole project, in one.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# A shell that starts the tests in the background has SIGINT ignored, in every process that they start, too.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(autouse=True)
def handlers() -> Iterator[None]:
    """Fail a test that leaves other handlers of signals behind, since a later one would fail for it."""
    before = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    yield
    after = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    assert after == before, "the handlers of signals are not as they were"


def pytest_report_header() -> str:
    """Say whether pictures of the real game are read, and why not."""
    folder = os.environ.get(VARIABLE)
    return f"real pictures: {folder}" if folder else f"real pictures: none are read, {VARIABLE} names no folder"


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Give every test its limit, and put those that need the stand-in last: once up, it takes more than a core."""
    if config.pluginmanager.hasplugin("timeout"):
        for item in items:
            bound(item)
    items.sort(key=lambda item: item.get_closest_marker("standin") is not None)


@pytest.hookimpl(optionalhook=True)  # under Wine there is no xdist
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """Let one process run the tests that share what is opened once, with ``--dist loadgroup``."""
    from tests.together import scheduler

    return scheduler(config, log)
