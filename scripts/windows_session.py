"""A Windows desktop under Wine, for as long as a block runs: a screen, a window manager, Wine's server, programs in it.

Standard library only, Linux only. Every process is ended by its own pid. Where this process is killed, the kernel sends
Wine's processes a signal.
"""

import os
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from scripts.window_display import OPENBOX, WITH_THIS_PROCESS, open_display, running
from scripts.windows_orphans import adopting
from scripts.windows_parts import ROOT, WINE, WINESERVER, windows_path
from scripts.windows_program import SessionError, WindowsProgram

PATIENCE_S = 20.0
"""Seconds in which a process must end when asked to."""
START_S = 180.0
"""Seconds in which Wine must have started, or made its prefix, on a busy machine."""

_ENDED_WITH_THIS_PROCESS = ("setpriv", "--pdeathsig", "INT", "--")
"""For Wine's server, which ends the programs of its prefix at SIGINT alone."""


@dataclass(frozen=True)
class Session:
    """A running desktop: the folder with its Python, and the environment of the programs in it."""

    cache: Path
    env: Mapping[str, str]

    @contextmanager
    def started(self, *arguments: str, cwd: Path = ROOT, **env: str) -> Iterator[WindowsProgram]:
        """The Windows Python with these arguments, until the end of the block; then it is ended, if it still runs."""
        command = [*WITH_THIS_PROCESS, WINE.required(), str(self.cache / "python" / "python.exe"), *arguments]
        with (
            subprocess.Popen(  # noqa: S603 - this project's own programs
                command,
                cwd=cwd,
                env={**self.env, **env},
                # Pipes, since python.exe takes no file of this system for its output, and no closed input.
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            ) as process,
            closing(WindowsProgram(process)) as program,
        ):
            yield program

    def python(self, *arguments: str, timeout_s: float, cwd: Path = ROOT, **env: str) -> tuple[int, str]:
        """Run the Windows Python to its end; returns its exit code and what it printed, errors included.

        Raises:
            SessionError: it took longer than ``timeout_s``; it is ended then.
        """
        with self.started(*arguments, cwd=cwd, **env) as program:
            return program.wait(timeout_s), program.printed()


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
        env = environment(cache, stack.enter_context(open_display())["DISPLAY"], home)
        stack.enter_context(running([OPENBOX.required()], env=env, log=logs / "openbox.log"))
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
        # Torch's OpenMP asks for the NUMA nodes' processors, which Wine doesn't know, unless it binds no threads.
        "KMP_AFFINITY": "disabled",
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
                [*WITH_THIS_PROCESS, WINE.required(), *arguments],
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


@contextmanager
def open_wineserver(env: Mapping[str, str], log: Path) -> Iterator[None]:
    """Wine's server in the foreground, kept between programs. At its end it ends every program of its prefix."""
    command = [*_ENDED_WITH_THIS_PROCESS, WINESERVER.required(), "--foreground", "--persistent"]
    with adopting(), running(command, env=dict(env), log=log):
        try:
            yield
        finally:
            stop = [WINESERVER.required(), "--kill"]
            subprocess.run(stop, env=dict(env), timeout=PATIENCE_S, check=False)  # noqa: S603 - fixed
