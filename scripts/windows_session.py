"""A Windows desktop under Wine, for as long as a block runs: a screen, a window manager, Wine's server, programs in it.

Linux only. Every process is ended by its own pid. Where this process is killed, the kernel sends Wine's processes a
signal.
"""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from scripts.programs import ROOT, Say, run_logged
from scripts.window_display import OPENBOX, WITH_THIS_PROCESS, adopting, end, open_display, running
from scripts.windows_parts import WINE, WINESERVER, windows_path

PATIENCE_S = 20.0
"""Seconds in which a process must end when asked to."""
START_S = 180.0
"""Seconds in which Wine must have started, or made its prefix, on a busy machine."""
LAST_WORDS_S = 1.0
"""Seconds after a program's end by which all that it printed has certainly come."""

WINDOWS = "win10"
"""The version that programs are told: Wine 8's own default is Windows 7, which Python 3.12 refuses."""

_ENDED_WITH_THIS_PROCESS = ("setpriv", "--pdeathsig", "INT", "--")
"""The signal for Wine's server, which ends the programs of its prefix only at SIGINT."""


class SessionError(Exception):
    """The desktop, or a program in it, did not start or end in time; the message is one line."""


@dataclass(frozen=True)
class WindowsProgram:
    """A running Windows program, and the file that what it prints is written to, as it comes, by ``writer``.

    The end of its pipe is not waited for: Wine's desktop, which the first program with a window starts, keeps it open.
    """

    process: subprocess.Popen[bytes]
    writer: subprocess.Popen[bytes]
    file: Path

    @property
    def has_ended(self) -> bool:
        """Whether it runs no more."""
        return self.process.poll() is not None

    def printed(self) -> str:
        """Return what it has printed so far, errors included; with this system's line ends."""
        return self.file.read_bytes().decode("utf-8", errors="replace").replace("\r\n", "\n")

    def wait(self, timeout_s: float) -> int:
        """Return its exit code, once all that it printed has come; SessionError where it takes longer."""
        try:
            code = self.process.wait(timeout_s)
        except subprocess.TimeoutExpired as error:
            last = (self.printed().strip().splitlines() or ["nothing"])[-1]
            raise SessionError(f"a program took more than {timeout_s:.0f} s; it said last: {last}") from error
        with suppress(subprocess.TimeoutExpired):
            self.writer.wait(LAST_WORDS_S)
        return code


@contextmanager
def printing(command: Sequence[str], *, cwd: Path, env: Mapping[str, str]) -> Iterator[WindowsProgram]:
    """Yield a program until the end of the block; then it is ended, if it still runs."""
    with ExitStack() as opened:
        file = Path(opened.enter_context(tempfile.TemporaryDirectory(prefix="mc-nested-windows-"))) / "printed"
        # Pipes, since python.exe takes no file of this system for its output, and no closed input.
        pipe = subprocess.PIPE
        process = opened.enter_context(
            subprocess.Popen(  # noqa: S603 - this project's own programs
                command, cwd=cwd, env=env, stdin=pipe, stdout=pipe, stderr=subprocess.STDOUT, start_new_session=True
            )
        )
        opened.callback(end, process)
        with file.open("wb") as output:
            writer = subprocess.Popen([*WITH_THIS_PROCESS, "cat"], stdin=process.stdout, stdout=output)  # noqa: S603 - fixed
        opened.callback(end, writer)
        yield WindowsProgram(process, writer, file)


@dataclass(frozen=True)
class Session:
    """A running desktop: the folder with its Python, and the environment of the programs in it."""

    cache: Path
    env: Mapping[str, str]

    @contextmanager
    def started(self, *arguments: str, cwd: Path = ROOT, **env: str) -> Iterator[WindowsProgram]:
        """Run the Windows Python with these arguments until the end of the block; then end it, if it still runs."""
        command = [*WITH_THIS_PROCESS, WINE.required(), str(self.cache / "python" / "python.exe"), *arguments]
        with printing(command, cwd=cwd, env={**self.env, **env}) as program:
            yield program

    def python(self, *arguments: str, timeout_s: float, cwd: Path = ROOT, **env: str) -> tuple[int, str]:
        """Run the Windows Python to its end; return its exit code and what it printed, errors included.

        Raises:
            SessionError: it took longer than ``timeout_s``; it is ended then.
        """
        with self.started(*arguments, cwd=cwd, **env) as program:
            return program.wait(timeout_s), program.printed()


@contextmanager
def open_session(cache: Path) -> Iterator[Session]:
    """Open a desktop of its own on a free display, with the prefix in ``cache``; after the block nothing is left.

    Raises:
        SessionError: a part of it did not start.
    """
    logs = cache / "logs"
    with _wine(cache) as env, running([OPENBOX.required()], env=env, log=logs / "openbox.log"):
        # Wine's services start with its first program, and would hold that program's pipes open.
        _run_wine(["wineboot"], env, logs)
        yield Session(cache, env)


def make_prefix(cache: Path, say: Say) -> None:
    """Make the prefix, the folder that holds Wine's Windows, unless this Wine has made it already.

    Raises:
        SessionError: Wine failed; its log is named.
    """
    prefix, stamp = cache / "prefix", cache / "prefix.made"
    asked = [WINE.required(), "--version"]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=60, check=False)  # noqa: S603 - fixed
    wanted = f"{answer.stdout.strip()} {WINESERVER.required()} {WINDOWS}"
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return
    say("making Wine's prefix, 700 MB")
    stamp.unlink(missing_ok=True)
    shutil.rmtree(prefix, ignore_errors=True)
    with _wine(cache) as env:
        _run_wine(["wineboot", "--init"], env, cache / "logs")
        _run_wine(["winecfg", "-v", WINDOWS], env, cache / "logs")
    stamp.write_text(wanted, encoding="utf-8")


@contextmanager
def _wine(cache: Path) -> Iterator[dict[str, str]]:
    """Open a display, and Wine's server in the foreground; yield the environment of Wine and its programs.

    The server is kept between programs. At its end it ends every program of its prefix.
    """
    home, logs = cache / "home", cache / "logs"
    for folder in (home, logs):
        folder.mkdir(exist_ok=True)
    with open_display() as display:
        env = {
            "PATH": os.environ.get("PATH", os.defpath),
            "LANG": "C.UTF-8",
            "HOME": str(home),
            "DISPLAY": display["DISPLAY"],
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
        command = [WINESERVER.required(), "--foreground", "--persistent"]
        server = running(command, env=env, log=logs / "wineserver.log", ended_with=_ENDED_WITH_THIS_PROCESS)
        with adopting(lambda name: name.endswith(".exe") or name.startswith("wine")), server:
            try:
                yield env
            finally:
                stop = [WINESERVER.required(), "--kill"]
                subprocess.run(stop, env=env, timeout=PATIENCE_S, check=False)  # noqa: S603 - fixed


def _run_wine(arguments: Sequence[str], env: Mapping[str, str], logs: Path) -> None:
    """Run one of Wine's own programs to its end; SessionError where that fails."""
    log = logs / "wine.log"
    if not run_logged([*WITH_THIS_PROCESS, WINE.required(), *arguments], log, env=env, timeout_s=START_S):
        raise SessionError(f"wine {' '.join(arguments)} failed, or took more than {START_S:.0f} s (see {log})")
