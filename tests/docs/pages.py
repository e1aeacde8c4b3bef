"""The steps that the pages tell a reader to do: commands, snippets and files, in the order of the page.

A block of ``bash`` holds commands, a line each. A block of ``text`` behind them in their section is what they print:
its lines come in this order, others between them, and ``…`` stands for whatever varies. A block of ``python`` is a
program. A block of another language that has a title is a file of that name. A command may also stand inline, as those
of figures do.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

ROOT = Path(__file__).resolve().parent.parent.parent

PROGRAMS = ("mc-nested", "python", "pip", "pytest", "mkdocs", "source", "ruff", "mypy", "lint-imports")
"""What a command begins with."""

FENCE = re.compile(r"^```(\w*)(?: title=\"([^\"]+)\")?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_INLINE = re.compile(rf"`((?:{'|'.join(PROGRAMS)}) [^`]+)`")
_HEADING = re.compile(r"^#+ ", re.MULTILINE)
_COMMENT = re.compile(r"(^|\s)#\s.*$")

Kind = Literal["command", "shown", "snippet", "file"]


@dataclass(frozen=True)
class Step:
    """One thing of a page: a command, what it prints, a Python program, or a file and its ``name``."""

    page: str
    line: int
    kind: Kind
    text: str
    name: str = ""

    def __str__(self) -> str:
        return f"{self.page}:{self.line}: {self.text}"


def pages() -> list[str]:
    """Return README and every page of docs/, from the project's root."""
    return ["README.md", *sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md"))]


def steps_of(page: str) -> list[Step]:
    """Return a page's steps, in its order."""
    whole = (ROOT / page).read_text("utf-8")
    steps: list[Step] = []
    behind_commands = -1
    for fence in FENCE.finditer(whole):
        language, name, body = fence.groups()
        line = whole.count("\n", 0, fence.start()) + 2
        if language == "bash":
            steps += [
                Step(page, line + number, "command", command)
                for number, typed in enumerate(body.splitlines())
                if (command := _COMMENT.sub("", typed).strip())
            ]
            behind_commands = fence.end()
        elif language == "text" and behind_commands >= 0 and not _HEADING.search(whole, behind_commands, fence.start()):
            steps.append(Step(page, line, "shown", body))
        elif language == "python":
            steps.append(Step(page, line, "snippet", body))
        elif name:
            steps.append(Step(page, line, "file", body, name))
    return steps


def inline_commands(page: str) -> list[Step]:
    """Return the commands in a page's text and tables."""
    whole = (ROOT / page).read_text("utf-8")
    without_blocks = FENCE.sub(lambda fence: "\n" * fence[0].count("\n"), whole)
    return [
        Step(page, without_blocks.count("\n", 0, found.start()) + 1, "command", " ".join(found[1].split()))
        for found in _INLINE.finditer(without_blocks)
    ]
