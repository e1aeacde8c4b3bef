"""Both kinds of Xwayland as fixtures."""

import sys
from collections.abc import Iterator

import pytest

from scripts.programs import OPENGL, install
from tests.found_or_skipped import found_or_skipped
from tests.live.desktop.real_windows.xwayland_desktop import PROGRAMS, rootful_desktop, rootless_desktop


@pytest.fixture(scope="session")
def compositors(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Install the programs, or skip."""
    if sys.platform != "linux":
        pytest.skip("Xwayland is for Linux")
    log = tmp_path_factory.mktemp("xwayland") / "install.log"
    found_or_skipped(lambda: install("a test on Xwayland", PROGRAMS, OPENGL, print, log))


@pytest.fixture(scope="module")
def rootful(compositors: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - its programs
    """Return the environment of an Xwayland that is one window of a Wayland desktop."""
    with rootful_desktop() as environment:
        yield environment


@pytest.fixture(scope="module", params=["weston", "mutter"])
def rootless(compositors: None, request: pytest.FixtureRequest) -> Iterator[dict[str, str]]:  # noqa: ARG001 - its programs
    """Return the environment of an Xwayland whose windows are a Wayland desktop's own; mutter is GNOME's."""
    with rootless_desktop(request.param) as environment:
        yield environment
