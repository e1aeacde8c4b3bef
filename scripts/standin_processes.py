"""Processes that outlive the script that started them: their start, their end, and the file that records them.

Standard library only, and Linux only: a process is known by its pid together with its start time in /proc.
"""

import json
import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path


class StandinError(Exception):
    """The stand-in did not start, or did not stop; the message is one line."""


@dataclass(frozen=True)
class Running:
    """One started process, the leader of its own session. A pid alone may have been reused by another process."""

    name: str
    pid: int
    started: int

    @property
    def is_alive(self) -> bool:
        """Whether this process still runs."""
        return start_time(self.pid) == self.started

    def pids(self) -> list[int]:
        """The pids of its session that still run: its own, and those of the processes that it started."""
        leader = start_time(self.pid)
        if leader is not None and leader != self.started:
            return []
        return [pid for pid in _all_pids() if _session_of(pid) == self.pid]


@dataclass
class State:
    """What `up` leaves for `status`, `down` and players; the file is written after every step."""

    path: Path
    ready: bool = False
    display: str = ""
    processes: list[Running] = field(default_factory=list)
    scratch: str = ""
    facts: dict[str, str] = field(default_factory=dict)

    def save(self) -> None:
        """Write the file atomically."""
        part = self.path.with_suffix(".part")
        part.write_text(json.dumps(self.as_json(), indent=1) + "\n", encoding="utf-8")
        part.replace(self.path)

    def as_json(self) -> dict[str, object]:
        """The file's content; scripts/standin.py explains the keys."""
        return {
            "ready": self.ready,
            "display": self.display,
            **self.facts,
            "pids": {process.name: process.pid for process in self.processes},
            "processes": [asdict(process) for process in self.processes],
            "scratch": self.scratch,
        }

    @property
    def is_up(self) -> bool:
        """Whether `up` finished and everything it started still runs."""
        return self.ready and all(process.is_alive for process in self.processes)


def load_state(path: Path) -> State | None:
    """The state that `up` left, None where there is none; StandinError where the file can't be used."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    try:
        content = json.loads(text)
        processes = [Running(each["name"], int(each["pid"]), int(each["started"])) for each in content["processes"]]
        known = {"ready", "display", "pids", "processes", "scratch"}
        facts = {str(key): str(value) for key, value in content.items() if key not in known}
        return State(path, content["ready"] is True, str(content["display"]), processes, str(content["scratch"]), facts)
    except (ValueError, KeyError, TypeError) as error:
        raise StandinError(f"{path} is damaged: stop what it names by hand, then delete it") from error


def start(
    name: str, command: Sequence[str], log: Path, cwd: Path, env: Mapping[str, str], keep: Sequence[int] = ()
) -> Running:
    """Start a process in a session of its own, its output in ``log``; ``keep`` are file descriptors it inherits."""
    with log.open("wb") as output:
        child = subprocess.Popen(  # noqa: S603 - the commands are fixed ones of the stand-in
            command,
            cwd=cwd,
            env=dict(env),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            start_new_session=True,
            pass_fds=keep,
        )
    child.returncode = 0  # otherwise Popen would warn that the process, which is meant to stay, still runs
    started = start_time(child.pid)
    if started is None:
        raise StandinError(f"{name} stopped at once: {last_line(log)}")
    return Running(name, child.pid, started)


def stop(process: Running, patience_s: float = 5.0) -> bool:
    """End a process and its session, with SIGTERM first and SIGKILL after ``patience_s``; whether it has ended."""
    for how in (signal.SIGTERM, signal.SIGKILL):
        pids = process.pids()
        if not pids:
            return True
        # Chromium ends its children in order when only it gets the signal.
        for pid in [process.pid] if how == signal.SIGTERM and process.pid in pids else pids:
            _send(pid, how)
        if wait_until(lambda: not process.pids(), patience_s):
            return True
    return False


def clean_up(state: State) -> None:
    """Stop everything that ``state`` names, last started first, and remove what it left on disk."""
    stubborn = [process for process in reversed(state.processes) if not stop(process)]
    if stubborn:
        names = ", ".join(f"{process.name} (pid {process.pid})" for process in stubborn)
        raise StandinError(f"these don't stop, end them by hand: {names}")
    if state.display:
        remove_socket(state.display)
    if state.scratch:
        shutil.rmtree(state.scratch, ignore_errors=True)
    state.path.unlink(missing_ok=True)


def wait_until(is_so: Callable[[], bool], timeout_s: float, every_s: float = 0.05) -> bool:
    """Whether ``is_so`` came true within ``timeout_s``."""
    end = time.monotonic() + timeout_s
    while not is_so():
        if time.monotonic() > end:
            return False
        time.sleep(every_s)
    return True


def start_time(pid: int) -> int | None:
    """When a process started, in clock ticks since boot; None for none, or one that has ended but isn't collected."""
    fields = _stat(pid)
    return int(fields[19]) if fields and fields[0] != "Z" else None


def last_line(log: Path) -> str:
    """The last line of a log that isn't blank."""
    lines = [line.strip() for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else f"{log} is empty"


def _stat(pid: int) -> list[str]:
    try:
        # The second field, a name in brackets, may contain blanks and brackets: count from the last bracket.
        return Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
    except (FileNotFoundError, ProcessLookupError):
        return []


def _session_of(pid: int) -> int | None:
    fields = _stat(pid)
    return int(fields[3]) if fields and fields[0] != "Z" else None


def _all_pids() -> list[int]:
    return [int(entry) for entry in os.listdir("/proc") if entry.isdigit()]  # noqa: PTH208 - names, not paths


def _send(pid: int, how: signal.Signals) -> None:
    with suppress(ProcessLookupError):
        os.kill(pid, how)


def remove_socket(display: str, folder: Path = Path("/tmp/.X11-unix")) -> None:  # noqa: S108 - where X has it
    """Remove the socket that a killed X server leaves, unless another server listens there."""
    path = folder / f"X{display.lstrip(':')}"
    with socket.socket(socket.AF_UNIX) as client:
        try:
            client.connect(str(path))
        except ConnectionRefusedError:
            path.unlink(missing_ok=True)
        except OSError:  # there is none
            return
