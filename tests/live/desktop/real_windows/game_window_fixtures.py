"""The windows of the game's other libraries as fixtures: their programs, fetched and compiled if they are missing.

A machine where that is impossible skips the test and says how to get them; with CI set, that is a failure.
"""

import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import pytest

from scripts.game_windows import SDL_3_2, SDL_3_4, Sdl, compiled, fetch_sdl, install_lwjgl_2
from scripts.standin_parts import MissingError
from scripts.window_display import open_display

SDL_WINDOW = Path(__file__).with_name("sdl3_window.py")
LWJGL_WINDOW = Path(__file__).with_name("Lwjgl2Window.java")

Found = TypeVar("Found")


def found_or_skipped(find: Callable[[], Found]) -> Found:
    """What was found."""
    try:
        return find()
    except MissingError as error:
        if os.environ.get("CI"):
            pytest.fail(str(error))
        pytest.skip(str(error))


@pytest.fixture(scope="module", params=[SDL_3_4, SDL_3_2], ids=lambda sdl: sdl.release)
def sdl_program(request: pytest.FixtureRequest) -> list[str]:
    """The program that shows a window of SDL 3."""
    sdl: Sdl = request.param
    return [sys.executable, str(SDL_WINDOW), str(found_or_skipped(lambda: fetch_sdl(sdl, print)))]


@pytest.fixture(scope="module")
def lwjgl_program(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The program that shows a window of LWJGL 2."""

    def find() -> list[str]:
        install_lwjgl_2(print, tmp_path_factory.mktemp("apt") / "apt.log")
        return compiled(LWJGL_WINDOW, tmp_path_factory.mktemp("classes"))

    return found_or_skipped(find)


@pytest.fixture(scope="module")
def desktop(window_programs: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - installs what is missing
    """The environment of an empty desktop with a window manager, which LWJGL 2 needs to get the focus."""
    with open_display(has_window_manager=True) as env:
        yield env
