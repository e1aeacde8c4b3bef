"""Both kinds of Xwayland as fixtures."""

import os
import sys
from collections.abc import Iterator

import pytest

from scripts.standin_parts import MissingError
from scripts.xwayland_parts import install_programs
from tests.live.desktop.real_windows.xwayland_desktop import rootful_desktop, rootless_desktop


@pytest.fixture(scope="session")
def compositors(tmp_path_factory: pytest.TempPathFactory) -> None:
    """The programs are there. A machine that lacks them skips the test and says how; with CI set, that is a failure."""
    if sys.platform != "linux":
        pytest.skip("Xwayland is for Linux")
    try:
        install_programs(print, tmp_path_factory.mktemp("xwayland") / "install.log")
    except MissingError as error:
        if os.environ.get("CI"):
            pytest.fail(str(error))
        pytest.skip(str(error))


@pytest.fixture(scope="module")
def rootful(compositors: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - its programs
    """The environment of an Xwayland that is one window of a Wayland desktop."""
    with rootful_desktop() as environment:
        yield environment


@pytest.fixture(scope="module", params=["weston", "mutter"])
def rootless(compositors: None, request: pytest.FixtureRequest) -> Iterator[dict[str, str]]:  # noqa: ARG001 - its programs
    """The environment of an Xwayland whose windows are a Wayland desktop's own; mutter is GNOME's."""
    with rootless_desktop(request.param) as environment:
        yield environment
