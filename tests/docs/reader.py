"""A reader who follows a page, step by step, in an empty folder.

Live commands play on the virtual desktop, whose clock doesn't wait; tests/test_rehearsal_end_to_end.py does the same in
the rehearsal window, in real time.
"""

import json
import re
import shlex
import sys
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from scripts import environment
from scripts.test import OTHERS
from tests.docs.pages import ROOT, Step
from tests.docs.rules import BY_THE_SUITE, IN_A_WINDOW, LIVE_SNIPPET, MEASURES, as_run, is_live
from tests.docs.shell import Shell, StepError
from tests.docs.windows import RehearsalWindows, VirtualDesktop

DRY_RUN = ("-m", "pip", "install", "--dry-run", "--quiet", "--disable-pip-version-check")
"""pip finds out what it would install, and leaves the environment as it is."""


IN_A_WINDOW_S = 600.0
"""A program that calibrates in a window, and then plays there, takes two minutes where nothing else runs."""

STRICT = ("-W", "error", "-W", "ignore:invalid escape sequence")
"""Every warning is an error. The exception is moviepy's own, which comes once if an old pip has left it uncompiled."""


class Reader:
    """Follows steps of a page, one after the other; StepError if one doesn't do what it should.

    Args:
        folder: an empty one.
        open_display: gives the environment of programs on a new display, for a page that opens a window.
    """

    def __init__(self, folder: Path, open_display: Callable[[], Mapping[str, str]] | None = None) -> None:
        self._shell = Shell(folder)
        self._desktop = VirtualDesktop(self._shell)
        self._windows = RehearsalWindows(self._shell, open_display)
        self._printed = ""
        self._ways: dict[str, Callable[[Step], str]] = {  # the first that a command begins with
            **dict.fromkeys(BY_THE_SUITE, lambda _: ""),
            "pytest": self._find_tests,
            "python scripts/demo.py": self._run_demo,
            "python scripts/": self._run_script,
            "source ": self._activate,
            "pip install ": self._install,
            "mkdocs build": self._build_site,
            "mc-nested rehearse": self._windows.open,
            "mc-nested ": self._run_verb,
        }

    def __enter__(self) -> "Reader":
        return self

    def __exit__(self, *_: object) -> None:
        self._windows.close()
        self._desktop.close()

    def follow(self, step: Step) -> None:
        """Do what the step says."""
        if step.kind == "command":
            self._printed += self._run(step)
        elif step.kind == "shown":
            missing = not_shown(step.text, self._printed)
            if missing is not None:
                raise StepError(step, f"this line isn't printed: {missing!r}; this is:\n{self._printed}")
            self._printed = ""
        elif step.kind == "snippet":
            self._printed = self._run_snippet(step)
        else:
            (self._shell.work / step.name).write_text(step.text, "utf-8")

    def take_screenshot(self, name: str) -> None:
        """Picture the game's window, as F2 does it."""
        self._desktop.ask(Step("", 0, "command", "F2"), {"screenshot": str(self._shell.work / name)})

    def _run(self, step: Step) -> str:
        way = next((way for begin, way in self._ways.items() if step.text.startswith(begin)), None)
        if way is None:
            raise StepError(step, "no rule runs it: see tests/docs/reader.py")
        return way(step)

    def _run_verb(self, step: Step) -> str:
        command = as_run(step.text)
        if not is_live(command):
            return self._shell.run(step, ["bash", "-c", f"{command}\nexit $?"])  # bash stays, as a reader's does
        words = [str(self._shell.home / word[2:]) if word[:2] == "~/" else word for word in shlex.split(command)]
        return self._desktop.ask(step, {"words": words[1:]})

    def _run_script(self, step: Step) -> str:
        command = as_run(step.text)
        words = shlex.split(command)[1:]
        if is_live(command):
            return self._desktop.ask(step, {"script": words})
        if command.startswith(IN_A_WINDOW):
            return self._run_in_a_window(step, words)
        return self._shell.run(step, [sys.executable, *words], ROOT)

    def _run_in_a_window(self, step: Step, words: list[str]) -> str:
        """Run a program that plays in a real window, or draws one; what it draws goes into the reader's folder."""
        command = [sys.executable, str(ROOT / words[0]), *words[1:]]
        if not step.text.startswith(MEASURES):
            return self._shell.run(step, command, limit_s=IN_A_WINDOW_S)
        printed = self._shell.run(step, command, limit_s=IN_A_WINDOW_S, may_end_with=(0, 1))
        figures = re.search(r"^\{.*\}$", printed, re.MULTILINE)
        if figures is None or what_is_wrong(json.loads(figures[0])):
            raise StepError(step, f"it measured nothing, or something was wrong:\n{printed}")
        return printed

    def _run_snippet(self, step: Step) -> str:
        if LIVE_SNIPPET in step.text:
            return self._desktop.ask(step, {"snippet": step.text})
        return self._shell.run(step, [sys.executable, *STRICT, "-c", step.text])

    def _run_demo(self, step: Step) -> str:
        """Run README's first command, in a clone whose environment is installed already: this one."""
        clone = self._shell.home / "clone"
        for folder in ("scripts", ".venv/bin"):
            (clone / folder).mkdir(parents=True)
        for name in ("scripts/demo.py", "scripts/environment.py", "pyproject.toml", "constraints.txt"):
            (clone / name).write_bytes((ROOT / name).read_bytes())
        python = clone / ".venv" / "bin" / "python"
        python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n', "utf-8")
        python.chmod(0o755)
        (clone / ".venv" / "installed").write_text(environment.stamp_of([]), "utf-8")
        return self._shell.run(step, [sys.executable, *shlex.split(step.text)[1:]], clone)

    def _activate(self, step: Step) -> str:
        self._shell.run(step, [sys.executable, "-m", "venv", "--without-pip", ".venv"])
        found = self._shell.run(step, ["bash", "-c", f"{step.text} && command -v python"])
        if found.strip() != str(self._shell.work / ".venv" / "bin" / "python"):
            raise StepError(step, f"python is {found}")
        return ""

    def _install(self, step: Step) -> str:
        said = self._shell.run(step, [sys.executable, *DRY_RUN, *shlex.split(step.text)[2:]], ROOT)
        if "does not provide the extra" in said:
            raise StepError(step, said)
        return ""

    def _build_site(self, step: Step) -> str:
        return self._shell.run(step, [*shlex.split(step.text), "--site-dir", self._shell.home / "site"], ROOT)

    def _find_tests(self, step: Step) -> str:
        """Check that the suite has tests with these markers."""
        words = shlex.split(step.text)[1:]
        options = dict(pairwise(words))
        files = [ROOT / word for word in words if word.endswith(".py")]
        named = re.compile(rf"def test_\w*{options.get('-k', '')}")
        if not all(named.search(file.read_text("utf-8")) for file in files) or options.get("-m", OTHERS) not in OTHERS:
            raise StepError(step, "the suite has no such tests")
        return ""


def what_is_wrong(figures: Any) -> list[str]:
    """Return the names of a benchmark's figures, at any depth, that say that something was wrong or failed."""
    if isinstance(figures, list):
        return [name for each in figures for name in what_is_wrong(each)]
    if not isinstance(figures, dict):
        return []
    wrong = [name for name in ("wrong", "wrong_cells", "wrong_blocks", "problem", "differences") if figures.get(name)]
    return [*wrong, *what_is_wrong(list(figures.values()))]


def not_shown(shown: str, printed: str) -> str | None:
    """Return the first line not printed behind the one before it; None if all are. Any blanks are alike."""
    lines = iter(" ".join(line.split()) for line in printed.splitlines())
    for expected in (" ".join(line.split()) for line in shown.splitlines() if line.strip()):
        form = re.compile(".*".join(re.escape(part) for part in expected.split("…")))
        if not any(form.fullmatch(line) for line in lines):
            return expected
    return None
