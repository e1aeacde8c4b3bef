"""Fetching the libraries of the game's windows, with a stand-in for pip; nothing here needs the network."""

import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from scripts import programs
from scripts.programs import MissingError
from tests.live.desktop import sdl_releases
from tests.live.desktop.sdl_releases import SDL_3_2, SDL_3_4, SDL_3_4_WINDOWS, Sdl, fetch_sdl

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="fetched on Linux alone")


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Sequence[str]]:
    """Return what pip was asked for; it gives a wheel that holds each library."""
    commands: list[Sequence[str]] = []

    def pip(command: Sequence[str], _log: Path, **_: Any) -> bool:
        commands.append([*command, Path(command[command.index("-r") + 1]).read_text(encoding="utf-8")])
        with zipfile.ZipFile(Path(command[-1]) / "tcod.whl", "w") as wheel:
            for sdl in (SDL_3_2, SDL_3_4, SDL_3_4_WINDOWS):
                wheel.writestr(sdl.member, sdl.release)
        return True

    monkeypatch.setattr(sdl_releases, "CACHE", tmp_path / "cache")
    monkeypatch.setattr(programs, "run_logged", pip)
    return commands


@pytest.mark.parametrize("sdl", [SDL_3_2, SDL_3_4, SDL_3_4_WINDOWS])
def test_a_library_is_fetched_once_by_its_hash_and_without_dependencies(sdl: Sdl, asked: list[Sequence[str]]) -> None:
    for _ in range(2):
        assert fetch_sdl(sdl, print).read_text() == sdl.release
    (command,) = asked
    assert {"--require-hashes", "--no-deps", "--only-binary", sdl.platform} <= set(command)
    assert command[-1] == f"{sdl.wheel} --hash=sha256:{sdl.sha256}\n"


def test_each_library_has_a_file_of_its_own(asked: list[Sequence[str]]) -> None:
    libraries = {fetch_sdl(sdl, print) for sdl in (SDL_3_2, SDL_3_4, SDL_3_4_WINDOWS)}
    assert len(libraries) == len(asked) == 3


@pytest.mark.usefixtures("asked")
def test_an_unreachable_package_index_is_a_one_line_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(programs, "run_logged", lambda *_, **__: False)
    with pytest.raises(MissingError, match=r"^pip could not fetch all of tcod==21\.2\.2\.txt .* be reached\?$"):
        fetch_sdl(SDL_3_4, print)
    assert not SDL_3_4.library.exists()
