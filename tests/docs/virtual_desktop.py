"""A program: runs ``mc-nested`` as a person types it, on a desktop whose one window is the virtual client's.

Reads a request a line, a JSON object: ``words`` of a command; ``script``, one of this project's and its words;
``snippet``, a Python program; or ``screenshot``, a file to write. Answers each in a line: ``code``, the exit code, and
``output``. The person at this desktop says yes to every question.
"""

import contextlib
import io
import json
import runpy
import sys
import traceback
import types
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import cv2

from mc_nested.live import desktop
from mc_nested.live.devices import Devices
from sim.client.client import VirtualClient
from tests.docs.pages import ROOT

Typed = TypeVar("Typed")
"""What a command is given."""

YES = "y\n" * 9
PITCH = 40.0
"""Degrees that the person looks down, across the arena to be."""


def main() -> None:
    """Answer requests until there are no more."""
    client = VirtualClient(pitch=PITCH)
    client.clock.sleep(0.3)
    install(client)
    from mc_nested.cli.app import main as mc_nested

    answers = sys.stdout
    for line in sys.stdin:
        request = json.loads(line)
        if "screenshot" in request:
            cv2.imwrite(request["screenshot"], client.display.grab())
            answer: dict[str, object] = {"code": 0, "output": ""}
        elif "script" in request:
            answer = answered(run_script, request["script"])
        elif "snippet" in request:
            answer = answered(run_snippet, request["snippet"])
        else:
            answer = answered(mc_nested, request["words"])
        print(json.dumps(answer), file=answers, flush=True)


def run_script(words: list[str]) -> None:
    """Run a script of this project, named from its root, as ``python`` does."""
    sys.argv = words
    runpy.run_path(str(ROOT / words[0]), run_name="__main__")


def run_snippet(program: str) -> None:
    """Run a Python program; a warning is an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exec(compile(program, "snippet", "exec"), {"__name__": "__main__"})  # noqa: S102 - a page's own


def answered(command: Callable[[Typed], None], words: Typed) -> dict[str, object]:
    """Run the command; what it says goes into the answer, the error included that ended a program."""
    said, code = io.StringIO(), 0
    requests, sys.stdin = sys.stdin, io.StringIO(YES)
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            command(words)
    except SystemExit as ended:
        code = ended.code if isinstance(ended.code, int) else 0
    except Exception:
        code = 1
        traceback.print_exc(file=said)
    finally:
        sys.stdin = requests
    return {"code": code, "output": said.getvalue()}


def install(client: VirtualClient) -> None:
    """Make this process's desktop the client's from here on. Nothing that opens one may be imported before."""

    @contextmanager
    def open_desktop(title: str) -> Iterator[Devices]:  # noqa: ARG001 - one window is all there is
        yield client.devices

    @contextmanager
    def open_nothing(*_: object) -> Iterator[None]:
        yield

    desktop.open_desktop = open_desktop
    system = desktop.this_system()
    vars(system).update(open_clipboard=lambda: client.clipboard, session_kind=lambda: "virtual")
    panic = types.ModuleType("mc_nested.live.desktop.panic")
    vars(panic).update(open_panic_switch=open_nothing, open_takeover_key=open_nothing)
    sys.modules[panic.__name__] = panic


if __name__ == "__main__":
    main()
