"""A running Windows program: what it prints, and its end. Standard library only."""

import select
import subprocess
import threading

PATIENCE_S = 20.0
"""Seconds in which a program must end when asked to."""
LAST_WORDS_S = 1.0
"""Seconds after its end in which what a program printed has certainly come."""
_LOOK_S = 0.1


class SessionError(Exception):
    """The desktop, or a program in it, did not start or end in time; the message is one line."""


class WindowsProgram:
    """A process that was started with a pipe for its output, which is read as it comes.

    The pipe's end is not waited for: Wine's desktop, which the first program with a window starts, keeps it open.
    """

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.process = process
        self._printed = bytearray()
        self._is_closing = threading.Event()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    @property
    def has_ended(self) -> bool:
        """Whether it runs no more."""
        return self.process.poll() is not None

    def size(self) -> int:
        """How many bytes it has printed so far."""
        return len(self._printed)

    def printed(self, since: int = 0, until: int | None = None) -> str:
        """What it has printed so far, errors included, between these bytes; with this system's line ends."""
        return bytes(self._printed[since:until]).decode("utf-8", errors="replace").replace("\r\n", "\n")

    def wait(self, timeout_s: float) -> int:
        """Its exit code, once all that it printed has come; SessionError where it takes longer than ``timeout_s``."""
        try:
            code = self.process.wait(timeout_s)
        except subprocess.TimeoutExpired as error:
            last = (self.printed().strip().splitlines() or ["nothing"])[-1]
            raise SessionError(f"a program took more than {timeout_s:.0f} s; it said last: {last}") from error
        self._reader.join(LAST_WORDS_S)
        return code

    def close(self) -> None:
        """End it, if it still runs, with SIGTERM first and SIGKILL after ``PATIENCE_S``."""
        if not self.has_ended:
            self.process.terminate()
            try:
                self.process.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self._is_closing.set()
        self._reader.join()

    def _read(self) -> None:
        pipe = self.process.stdout
        if pipe is None:
            return
        while not self._is_closing.is_set():
            if select.select([pipe], [], [], _LOOK_S)[0]:
                data = pipe.read1(65536)  # type: ignore[attr-defined]  # Popen's pipes are buffered readers
                if not data:
                    return
                self._printed += data
