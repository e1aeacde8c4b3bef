"""The windows of the game's other libraries as fixtures: their programs, fetched and compiled if they are missing."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from scripts.programs import Program, install
from scripts.window_display import open_display
from tests.found_or_skipped import found_or_skipped
from tests.live.desktop.sdl_releases import SDL_3_2, SDL_3_4, Sdl, fetch_sdl

SDL_WINDOW = Path(__file__).with_name("sdl3_window.py")
LWJGL_WINDOW = Path(__file__).with_name("Lwjgl2Window.java")

JAVA = Program(("java",), "default-jre")
JAVAC = Program(("javac",), "default-jdk-headless")
LWJGL_2 = ("liblwjgl-java", "liblwjgl-java-jni", "default-jre")
"""Debian's packages of the library to 1.12, which needs AWT with its windows: a headless JRE lacks them."""
LWJGL_2_JAR, NATIVES = "/usr/share/java/lwjgl.jar", "/usr/lib/jni"


@pytest.fixture(scope="module", params=[SDL_3_4, SDL_3_2], ids=lambda sdl: sdl.release)
def sdl_program(request: pytest.FixtureRequest) -> list[str]:
    """Return the program that shows a window of SDL 3."""
    sdl: Sdl = request.param
    return [sys.executable, str(SDL_WINDOW), str(found_or_skipped(lambda: fetch_sdl(sdl, print)))]


@pytest.fixture(scope="module")
def lwjgl_program(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """Return the program that shows a window of LWJGL 2."""

    def find() -> list[str]:
        install("a window of LWJGL 2", [JAVAC], LWJGL_2, print, tmp_path_factory.mktemp("apt") / "apt.log")
        folder = str(tmp_path_factory.mktemp("classes"))
        command = [JAVAC.required(), "-cp", LWJGL_2_JAR, "-d", folder, str(LWJGL_WINDOW)]
        subprocess.run(command, check=True, timeout=120)
        classes = os.pathsep.join((LWJGL_2_JAR, folder))
        return [JAVA.required(), f"-Djava.library.path={NATIVES}", "-cp", classes, LWJGL_WINDOW.stem]

    return found_or_skipped(find)


@pytest.fixture(scope="module")
def desktop(window_programs: None) -> Iterator[dict[str, str]]:  # noqa: ARG001 - installs what is missing
    """Return the environment of an empty desktop with a window manager, which LWJGL 2 needs to get the focus."""
    with open_display(has_window_manager=True) as env:
        yield env
