"""A Windows desktop under Wine, for as long as a block runs: a screen, a window manager, Wine's server, programs in it.

Standard library only, Linux only. Every process is ended by its own pid, and each ends by itself where this process is
killed: the kernel sends it SIGTERM then.
"""

import os
import select
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from scripts.standin_processes import remove_socket
from scripts.windows_parts import OPENBOX, ROOT, WINE, WINESERVER, XVFB, windows_path

SCREEN = "1400x1000x24"
PATIENCE_S = 20.0
"""Seconds in which a screen must come up, and a process must end when asked to."""
START_S = 180.0
"""Seconds in which Wine must have started, or made its prefix, on a busy machine."""

_WITH_THIS_PROCESS = ("setpriv", "--pdeathsig", "TERM", "--")


class SessionError(Exception):
    """The desktop, or a program in it, did not start or end in time; the message is one line."""


@dataclass(frozen=True)
class Session:
    """A running desktop: where its screen is, and the environment of the programs in it."""

    cache: Path
    env: Mapping[str, str]

    @property
    def display(self) -> str:
        """The X display."""
        return self.env["DISPLAY"]

    @contextmanager
    def started(self, *arguments: str, cwd: Path = ROOT, **env: str) -> Iterator[subprocess.Popen[bytes]]:
        """The Windows Python with these arguments, until the end of the block; then it is ended, if it still runs.

        Its three streams are pipes, as python.exe needs them: under Wine it refuses a file that is only written to.
        """
        command = [*_WITH_THIS_PROCESS, WINE.required(), str(self.cache / "python" / "python.exe"), *arguments]
        with subprocess.Popen(  # noqa: S603 - this project's own programs
            command,
            cwd=cwd,
            env={**self.env, **env},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        ) as process:
            try:
                yield process
            finally:
                end(process)

    def python(self, *arguments: str, timeout_s: float, cwd: Path = ROOT, **env: str) -> tuple[int, str]:
        """Run the Windows Python to its end; returns its exit code and what it printed, errors included.

        Raises:
            SessionError: it took longer than ``timeout_s``; it is ended then.
        """
        with self.started(*arguments, cwd=cwd, **env) as process:
            try:
                printed, _ = process.communicate(timeout=timeout_s)
            except subprocess.TimeoutExpired as error:
                said = as_text(error.output or b"").strip().splitlines()[-1:] or ["nothing"]
                raise SessionError(f"{arguments} took more than {timeout_s:.0f} s; it said last: {said[0]}") from error
        return process.returncode, as_text(printed)


def as_text(printed: bytes) -> str:
    """What a Windows program printed, with this system's line ends."""
    return printed.decode("utf-8", errors="replace").replace("\r\n", "\n")


@contextmanager
def open_session(cache: Path) -> Iterator[Session]:
    """A desktop of its own on a free display, with the prefix in ``cache``; nothing of it is left after the block.

    Raises:
        SessionError: a part of it did not start.
    """
    logs, home = cache / "logs", cache / "home"
    for folder in (logs, home):
        folder.mkdir(exist_ok=True)
    with ExitStack() as stack:
        display = stack.enter_context(open_screen(logs / "xvfb.log"))
        env = environment(cache, display, home)
        stack.enter_context(running([OPENBOX.required()], env, logs / "openbox.log"))
        stack.enter_context(open_wineserver(env, logs / "wineserver.log"))
        # Wine's services start with its first program, and would hold that program's pipes open.
        run_wine(["wineboot"], env, logs / "wine.log")
        yield Session(cache, env)


def environment(cache: Path, display: str, home: Path) -> dict[str, str]:
    """The environment of Wine and of the programs in it."""
    return {
        "PATH": os.environ.get("PATH", os.defpath),
        "LANG": "C.UTF-8",
        "HOME": str(home),
        "DISPLAY": display,
        "WINEPREFIX": str(cache / "prefix"),
        "WINEDEBUG": "-all",
        # No .NET, no HTML, no menu entries, no debugger that a crash would hang in; Microsoft's C library.
        "WINEDLLOVERRIDES": "mscoree,mshtml,winedbg.exe,winemenubuilder.exe=;ucrtbase=n,b",
        "PYTHONPYCACHEPREFIX": windows_path(cache / "pycache"),
        "PYTHONIOENCODING": "utf-8",
        "NUMBA_CACHE_DIR": windows_path(cache / "numba"),
        **{name: os.environ[name] for name in ("CI", "MC_NESTED_SCREENSHOTS") if name in os.environ},
    }


def run_wine(arguments: Sequence[str], env: Mapping[str, str], log: Path) -> None:
    """Run one of Wine's own programs to its end; SessionError where that fails."""
    with log.open("ab") as output:
        try:
            done = subprocess.run(  # noqa: S603 - fixed commands
                [*_WITH_THIS_PROCESS, WINE.required(), *arguments],
                env=dict(env),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=output,
                timeout=START_S,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise SessionError(f"wine {' '.join(arguments)} took more than {START_S:.0f} s (see {log})") from error
    if done.returncode != 0:
        raise SessionError(f"wine {' '.join(arguments)} failed (see {log})")


def end(process: subprocess.Popen[bytes]) -> None:
    """End a process that still runs, with SIGTERM first and SIGKILL after ``PATIENCE_S``."""
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextmanager
def open_screen(log: Path) -> Iterator[str]:
    """An X server on a free display, whose number it writes to a pipe once it is ready."""
    reading, writing = os.pipe()
    with ExitStack() as stack:
        stack.callback(os.close, reading)
        with os.fdopen(writing, "wb") as its_end:
            command = [XVFB.required(), "-displayfd", str(writing), "-screen", "0", SCREEN, "-nolisten", "tcp"]
            server = stack.enter_context(running(command, os.environ, log, its_end))
        number, deadline = b"", time.monotonic() + PATIENCE_S
        while not number.endswith(b"\n"):
            if not select.select([reading], [], [], max(0.0, deadline - time.monotonic()))[0]:
                raise SessionError(f"the screen took more than {PATIENCE_S:.0f} s to start (see {log})")
            read = os.read(reading, 64)
            if not read:
                raise SessionError(f"the screen did not start (see {log})")
            number += read
        display = f":{int(number)}"
        stack.callback(remove_socket, display)
        stack.callback(end, server)
        yield display


@contextmanager
def open_wineserver(env: Mapping[str, str], log: Path) -> Iterator[None]:
    """Wine's server in the foreground, kept between programs. At its end it ends every program of its prefix."""
    command = [WINESERVER.required(), "--foreground", "--persistent"]
    with running(command, env, log) as server:
        try:
            yield
        finally:
            stop = [WINESERVER.required(), "--kill"]
            subprocess.run(stop, env=dict(env), timeout=PATIENCE_S, check=False)  # noqa: S603 - fixed
            try:
                server.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                end(server)


@contextmanager
def running(
    command: Sequence[str], env: Mapping[str, str], log: Path, keep: IO[bytes] | None = None
) -> Iterator[subprocess.Popen[bytes]]:
    """A process with its output in ``log``, ended at the end of the block; it inherits the file ``keep``."""
    with log.open("wb") as output:
        process = subprocess.Popen(  # noqa: S603 - fixed commands
            [*_WITH_THIS_PROCESS, *command],
            env=dict(env),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            start_new_session=True,
            pass_fds=[keep.fileno()] if keep else [],
        )
    try:
        yield process
    finally:
        end(process)
