"""Missing programs are installed, by a stand-in for apt-get on the PATH; a second run waits for the first."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from scripts.programs import OPENGL, XDOTOOL, XVFB, MissingError, Program, alone, install
from tests.scripts.fake_programs import silent, write_program

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="these programs are for Linux")

WESTON = Program(("weston",), "weston")
BROWSER = Program(("chromium", "google-chrome"), "chromium")
WANTED = (WESTON, BROWSER, XVFB, XDOTOOL)


def test_root_installs_only_the_missing_packages(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 0)
    calls = tmp_path / "calls"
    write_program(programs, "google-chrome")
    write_program(programs, "Xvfb")
    write_program(programs, "dpkg-query", "sys.stdout.write('install ok installed' * (sys.argv[-1] == 'libgl1'))")
    write_program(programs, "apt-get", f"open({str(calls)!r}, 'a').write(' '.join(sys.argv[1:]) + '\\n')")
    install("a test", WANTED, OPENGL, silent, tmp_path / "log")
    assert calls.read_text().splitlines() == [
        "update",
        "install -y --no-install-recommends libgl1-mesa-dri weston xdotool",
    ]


def test_user_who_is_not_root_gets_the_command_to_run(
    tmp_path: Path, programs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_program(programs, "apt-get", "raise SystemExit('must not run')")
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    with pytest.raises(MissingError, match=r"only root can install: sudo apt-get .* chromium weston xdotool xvfb$"):
        install("a test", WANTED, OPENGL, silent, tmp_path / "log")
    assert not (tmp_path / "log").exists()


def test_error_without_apt_names_the_packages_to_install(tmp_path: Path, programs: Path) -> None:
    assert not list(programs.iterdir())
    with pytest.raises(MissingError, match=r"a test needs .* chromium weston xdotool xvfb$"):
        install("a test", WANTED, OPENGL, silent, tmp_path / "log")


def test_apt_is_not_run_if_every_program_is_there(tmp_path: Path, programs: Path) -> None:
    for name in ("weston", "chromium", "Xvfb", "xdotool"):
        write_program(programs, name)
    install("a test", WANTED, OPENGL, silent, tmp_path / "log")
    assert not (tmp_path / "log").exists()


HOLDS = (
    "import sys; from pathlib import Path; from scripts.programs import alone\n"
    "with alone(Path(sys.argv[1]), print, 'x'): print('mine', flush=True); sys.stdin.read()"
)


def test_second_run_waits_for_the_first_and_gives_up_in_one_line(tmp_path: Path) -> None:
    said: list[str] = []
    command = [sys.executable, "-c", HOLDS, str(tmp_path)]
    root = Path(__file__).parents[2]
    with subprocess.Popen(command, cwd=root, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "mine\n"
        with (
            pytest.raises(RunError, match=f"process {other.pid} is writing there: wait until it ends, or stop it"),
            alone(tmp_path, said.append, "x.py", 0.1),
        ):
            pytest.fail("two at a time")
        other.kill()
    assert said == ["waiting for another x.py to end"]
    with alone(tmp_path, said.append, "x.py", 0.1):
        assert len(said) == 1
