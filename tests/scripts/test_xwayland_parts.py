"""What is installed for the tests on Xwayland, with a stand-in for apt-get on the PATH."""

import os
import sys
from pathlib import Path

import pytest

from scripts import xwayland_parts
from scripts.standin_parts import MissingError

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Xwayland is for Linux")


@pytest.fixture
def programs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that is the whole PATH."""
    folder = tmp_path / "bin"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def write_program(folder: Path, name: str, code: str = "") -> None:
    path = folder / name
    path.write_text(f"#!{sys.executable}\nimport sys\n{code}\n")
    path.chmod(0o755)


def test_what_is_missing_is_installed_by_its_package(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    asked = tmp_path / "asked"
    write_program(programs, "Xvfb")
    write_program(programs, "xdotool")
    write_program(programs, "dpkg-query", "sys.stdout.write('install ok installed' * (sys.argv[-1] == 'libgl1'))")
    write_program(programs, "apt-get", f"open({str(asked)!r}, 'a').write(' '.join(sys.argv[1:]) + '\\n')")
    xwayland_parts.install_programs(print, tmp_path / "log")
    assert asked.read_text().splitlines() == [
        "update",
        "install -y --no-install-recommends dbus-daemon libgl1-mesa-dri mutter weston xwayland",
    ]


def test_where_apt_is_missing_the_line_says_what_to_install(tmp_path: Path, programs: Path) -> None:
    assert not list(programs.iterdir())
    with pytest.raises(MissingError, match=r"a test on Xwayland needs .* weston xdotool xvfb xwayland$"):
        xwayland_parts.install_programs(print, tmp_path / "log")


def test_nothing_is_asked_of_apt_where_all_is_there(tmp_path: Path, programs: Path) -> None:
    for name in ("weston", "weston-terminal", "mutter", "dbus-daemon", "Xwayland", "Xvfb", "xdotool"):
        write_program(programs, name)
    xwayland_parts.install_programs(print, tmp_path / "log")
    assert not (tmp_path / "log").exists()
