"""Small pieces of Markdown: a table, a docstring, a number."""

import re
import string
from collections.abc import Iterable, Sequence

_PAGE = re.compile(r"docs/([a-z-]+)/([a-z-]+)\.md")

MANY = 60
"""Characters of a value that are shown in a table: more would leave no room beside it."""


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table of Markdown cells; a pipe outside code would end a cell, so it is escaped."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(_cell(text) for text in line) + " |" for line in lines) + "\n"


def code(text: str) -> str:
    """Return a text as code, shortened if it is long."""
    shown = text if len(text) <= MANY else text[: MANY - 1] + "…"
    return f"`` {shown} ``" if "`" in shown else f"`{shown}`"


def of_docstring(text: str | None) -> str:
    """Return a docstring as the reference's Markdown: its code is in single back quotes, a named page is a link."""
    lines = (text or "").split("\n")
    plain = "\n".join(line.strip() for line in lines).replace("``", "`").strip()
    return _PAGE.sub(r"[\2](../\1/\2.md)", plain)


def sentence(text: str) -> str:
    """Return the text with a full stop, and a capital if it begins with a word and not with a symbol such as ε."""
    first = text[:1].upper() if text[:1] in string.ascii_lowercase else text[:1]
    return first + text[1:] + ("" if text.endswith((".", "!", "?")) or not text else ".")


def number(value: float) -> str:
    """Return a number with commas between thousands, and no decimals that say nothing."""
    return f"{int(value):,}" if value == int(value) else f"{value:,}"


def _cell(text: str) -> str:
    parts = " ".join(text.split()).split("`")
    return "`".join(part if index % 2 else part.replace("|", "\\|") for index, part in enumerate(parts))
