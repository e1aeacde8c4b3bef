"""The project's own environment: .venv beside pyproject.toml, made and updated by the other scripts.

Needs nothing but Python 3.10 to 3.14. Versions come from constraints.txt.
"""

from __future__ import annotations  # an older Python reads this file, too, and says so

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

ROOT = Path(__file__).resolve().parent.parent
ENVIRONMENT = ROOT / ".venv"
STAMP = ENVIRONMENT / "installed"
OLDEST_PYTHON, NEWEST_PYTHON = (3, 10), (3, 14)
ENDS_WITHIN_S = 20.0
"""Seconds for a command to end by itself, after the terminal's Ctrl+C, before it is asked, and asked more firmly."""


def main_python(extras: Sequence[str] = ()) -> Path:
    """Return the environment's Python, with the project and extras installed; exit with one line if that fails."""
    if sys.version_info < OLDEST_PYTHON:
        _end(f"Python {sys.version.split()[0]} is too old: run this with Python 3.10 to 3.14")
    if sys.version_info[:2] > NEWEST_PYTHON:
        _end(f"Python {sys.version.split()[0]} is too new for numba and torch: run this with Python 3.10 to 3.14")
    python = ENVIRONMENT / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    if not python.exists():
        _make_environment()
    wanted = stamp_of(extras)
    if not STAMP.is_file() or STAMP.read_text() != wanted:
        STAMP.unlink(missing_ok=True)
        print("installing the project; torch is large, the first time takes minutes", flush=True)
        install(python, extras, ["-e", "."])
        _settle_xlib(python)
        STAMP.write_text(wanted)
    return python


def install(python: Path, extras: Sequence[str], project: Sequence[str]) -> None:
    """Install the project, named by the words that pip takes, with the extras; exits with one line if that fails."""
    *options, where = project
    if _can_build_evdev():
        _pip(python, *options, f"{where}[{','.join(extras)}]" if extras else where)
    else:
        _install_without_evdev(python, extras, project)


def run(command: Sequence[str | Path], variables: Mapping[str, str] | None = None) -> int:
    """Run a command in the project's root, with these environment variables too, and return its exit code.

    After Ctrl+C the command is ended first; then KeyboardInterrupt is raised.
    """
    process = start(command, variables)
    try:
        return process.wait()
    finally:
        end(process)


def start(
    command: Sequence[str | Path], variables: Mapping[str, str] | None = None, output: int | None = None
) -> subprocess.Popen[bytes]:
    """Start a command in the project's root, with these environment variables too; ``output`` is a file's number."""
    words, everything = [str(part) for part in command], {**os.environ, **(variables or {})}
    return subprocess.Popen(words, cwd=ROOT, env=everything, stdout=output, stderr=output and subprocess.STDOUT)  # noqa: S603 - our own


def end(process: subprocess.Popen[bytes]) -> None:
    """End a command that still runs, and what it has started: as Ctrl+C does, unless that is under way already."""
    asks: Sequence[Callable[[], None]] = (
        lambda: None,
        lambda: process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM),
        process.terminate,
        process.kill,
    )
    for ask in asks:
        if process.poll() is None:
            ask()
            with suppress(subprocess.TimeoutExpired):
                process.wait(ENDS_WITHIN_S)


def _end(line: str) -> NoReturn:
    """Say what is wrong and what to do, and exit with 2, as for any mistake."""
    print(line, file=sys.stderr)
    sys.exit(2)


def _make_environment() -> None:
    print(f"making {ENVIRONMENT}", flush=True)
    if run([sys.executable, "-m", "venv", ENVIRONMENT]):
        shutil.rmtree(ENVIRONMENT, ignore_errors=True)
        _end("no virtual environment could be made: install Python's venv (on Debian: apt install python3-venv)")


def stamp_of(extras: Sequence[str]) -> str:
    """Return what STAMP holds once the project is installed with these extras."""
    sources = [(ROOT / name).read_bytes() for name in ("pyproject.toml", "constraints.txt")]
    return hashlib.sha256(b"".join(sources)).hexdigest() + " " + ",".join(sorted(extras))


def _pip(python: Path, *what: str) -> None:
    if run([python, "-m", "pip", "install", "--disable-pip-version-check", "-c", "constraints.txt", *what]):
        _end("installing failed: see pip's message above, fix that and run this again")


def _can_build_evdev() -> bool:
    """Return whether pynput's Linux dependency evdev, which comes as C source only, can be compiled here."""
    if not sys.platform.startswith("linux"):
        return True
    headers = (Path(sysconfig.get_paths()["include"]) / "Python.h", Path("/usr/include/linux/input.h"))
    return shutil.which("cc") is not None and all(header.exists() for header in headers)


def _install_without_evdev(python: Path, extras: Sequence[str], project: Sequence[str]) -> None:
    """Install everything but evdev: pynput needs it only for a console without X11, which nothing here uses."""
    print("no C compiler or headers here: installing pynput without evdev", flush=True)
    _pip(python, "--no-deps", *project)
    listing = "import importlib.metadata, json; print(json.dumps(importlib.metadata.requires('mc-nested')))"
    found = subprocess.run([str(python), "-c", listing], cwd=ROOT, capture_output=True, check=True, text=True)  # noqa: S603 - our own
    _pip(python, "six", *_requirements_but_pynput(json.loads(found.stdout), extras))
    _pip(python, "--no-deps", "pynput")


def _requirements_but_pynput(requirements: Sequence[str], extras: Sequence[str]) -> list[str]:
    kept = []
    for requirement in requirements:
        extra = re.search(r"""extra == ['"]([\w-]+)['"]""", requirement)
        if requirement.startswith("pynput") or (extra and extra[1] not in extras):
            continue
        kept.append(requirement.split(";")[0].strip() if extra else requirement)
    return kept


def _settle_xlib(python: Path) -> None:
    """Install python-xlib last: pyautogui brings the far older python3-xlib, and both are named Xlib."""
    if sys.platform.startswith("linux"):
        _pip(python, "--quiet", "--no-deps", "--force-reinstall", "python-xlib")
