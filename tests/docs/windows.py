"""Where live commands of a page play: the virtual desktop; and the rehearsal window that a page opens."""

import json
import shlex
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from typing import Any

from scripts.window_display import WITH_THIS_PROCESS
from tests.docs.pages import Step
from tests.docs.shell import LONGEST_S, Shell, StepError

OPEN = "Close the window to end."
"""The last line that an open rehearsal has printed."""

OPEN_S = 60.0


class VirtualDesktop:
    """A process of tests/docs/virtual_desktop.py, begun when it is first asked for."""

    def __init__(self, shell: Shell) -> None:
        self._shell = shell
        self._process: subprocess.Popen[str] | None = None

    def ask(self, step: Step, request: Mapping[str, Any]) -> str:
        """Return what a command prints there; StepError if it fails, or takes too long."""
        process = self._process = self._process or self._begin()
        if process.stdin is None or process.stdout is None:
            raise AssertionError("it was begun with pipes")
        too_long = threading.Timer(LONGEST_S, process.kill)
        too_long.start()
        try:
            process.stdin.write(json.dumps(request) + "\n")
            process.stdin.flush()
            line = process.stdout.readline()
        finally:
            too_long.cancel()
        if not line:
            raise StepError(step, "the virtual desktop has ended: see what it said above")
        answer = json.loads(line)
        if answer["code"]:
            raise StepError(step, f"exit code {answer['code']}:\n{answer['output']}")
        return str(answer["output"])

    def close(self) -> None:
        """End it."""
        if self._process is not None:
            with self._process:  # closes its pipes, and waits
                pass

    def _begin(self) -> "subprocess.Popen[str]":
        words = [sys.executable, "-m", "tests.docs.virtual_desktop"]
        pipe = subprocess.PIPE
        return subprocess.Popen(words, cwd=self._shell.work, env=self._shell.env, stdin=pipe, stdout=pipe, text=True)


class RehearsalWindows:
    """Opens rehearsal windows one after the other, on a display of their own."""

    def __init__(self, shell: Shell, open_display: Callable[[], Mapping[str, str]] | None) -> None:
        self._shell = shell
        self._open_display = open_display
        self._opened = ExitStack()

    def open(self, step: Step) -> str:
        """Open the window in place of the one before, and return what it prints; StepError if it doesn't open."""
        if self._open_display is None:
            raise StepError(step, "opens a window: mark the test of its page so")
        self.close()
        display = self._open_display()
        env = {**self._shell.env, **{name: display[name] for name in ("DISPLAY", "XDG_SESSION_TYPE")}}
        log = self._shell.home / "rehearsal.log"
        with log.open("w") as output:
            words = [*WITH_THIS_PROCESS, *shlex.split(step.text)]
            window = subprocess.Popen(words, cwd=self._shell.work, env=env, stdout=output, stderr=subprocess.STDOUT)
        self._opened.callback(window.wait)
        self._opened.callback(window.terminate)
        end = time.monotonic() + OPEN_S
        while OPEN not in (printed := log.read_text("utf-8")):
            if window.poll() is not None or time.monotonic() > end:
                raise StepError(step, f"no window opens:\n{printed}")
            time.sleep(0.1)
        return printed

    def close(self) -> None:
        """Close the window that is open."""
        self._opened.close()
