"""Where a file of the project is on the site. Pages link to files as they lie in the project, so links work there, too.

docs/ is the site; a few pages, and the pictures, lie elsewhere.
"""

import posixpath
import re
from collections.abc import Callable
from pathlib import PurePosixPath

PAGES = {
    "README.md": "project/readme.md",
    "ARCHITECTURE.md": "explanation/architecture.md",
    "mc_nested/live/FACTS.md": "explanation/facts.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "CHANGELOG.md": "project/changelog.md",
    "LICENSE": "project/license.txt",
}
"""Files outside of docs/ that are pages of the site."""

PICTURES = "scripts"
"""The folder of the project's pictures."""

SUFFIXES = (".png", ".gif", ".svg")

_LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s]+)(\))")
_FENCE = re.compile(r"^(```.*?^```[ \t]*$)", re.MULTILINE | re.DOTALL)


def place_of(file: str) -> str | None:
    """Where a file, named from the project's root, is on the site; None if it isn't there."""
    path = PurePosixPath(file)
    if file in PAGES:
        return PAGES[file]
    if path.parts[:1] == ("docs",):
        return str(path.relative_to("docs"))
    if str(path.parent) == PICTURES and path.suffix in SUFFIXES:
        return f"pictures/{path.name}"
    return None


def file_of(place: str) -> str:
    """The file, named from the project's root, of a page of the site."""
    return next((file for file, at in PAGES.items() if at == place), f"docs/{place}")


def with_links_of_site(markdown: str, place: str, lost: Callable[[str], None]) -> str:
    """A page's Markdown with each link to a file of the project turned into one on the site.

    Args:
        markdown: the page, as it is in the project.
        place: where it is on the site.
        lost: is told each link to what isn't on the site; it stays as it is.
    """
    folder = posixpath.dirname(file_of(place))

    def moved(link: re.Match[str]) -> str:
        target, mark, anchor = link[2].partition("#")
        if not target or re.match(r"[a-z]+:", target):
            return link[0]
        there = place_of(posixpath.normpath(posixpath.join(folder, target)))
        if there is None:
            lost(link[2])
            return link[0]
        return f"{link[1]}{posixpath.relpath(there, posixpath.dirname(place))}{mark}{anchor}{link[3]}"

    parts = _FENCE.split(markdown)
    return "".join(part if part.startswith("```") else _LINK.sub(moved, part) for part in parts)
