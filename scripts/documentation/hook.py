"""What mkdocs.yml hooks into MkDocs: pages and pictures from outside of docs/, and the reference, made from the code.

A page names what is to be made in a comment: ``<!-- made from the code: profile -->``. Pages link to files as they lie
in the project, so that links work there, too.
"""

import posixpath
import re
import sys
from collections.abc import Callable
from pathlib import Path, PurePosixPath

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent))

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from mc_nested.arena.scenario_file import ScenarioTable, shipped_scenarios
from mc_nested.learn.preset import Preset, shipped_presets
from mc_nested.live.profile.tables import Profile
from scripts.documentation import reference, table_reference

ROOT = Path(__file__).resolve().parent.parent.parent

LOG = get_plugin_logger("documentation")

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

_CELL = re.compile(r"<td.*?</td>", re.DOTALL)
_CODE = re.compile(r"<code>([^<]*)</code>")

MADE = re.compile(r"^<!-- made from the code: ([a-z ]+) -->$", re.MULTILINE)


def program(file: str) -> str:
    """Return the text of a Python program, named from the project's root."""
    return f"```python\n{(ROOT / file).read_text('utf-8').rstrip()}\n```"


def shipped_files(folder: str, names: list[str]) -> str:
    """Return the text of shipped TOML files, each under its name."""
    texts = ((name, (ROOT / folder / f"{name}.toml").read_text("utf-8").rstrip()) for name in names)
    return "\n\n".join(f"### {name}\n\n```toml\n{text}\n```" for name, text in texts)


MAKERS: dict[str, Callable[[], str]] = {
    "command line": reference.command_line,
    "profile": lambda: table_reference.markdown(Profile),
    "preset": lambda: table_reference.markdown(Preset),
    "scenario": lambda: table_reference.markdown(ScenarioTable),
    "shipped presets": lambda: shipped_files("mc_nested/learn/presets", shipped_presets()),
    "shipped designs": lambda: shipped_files("mc_nested/arena/designs", shipped_scenarios()),
    "stable baselines example": lambda: program("scripts/examples/sb3_dqn.py"),
    "single file example": lambda: program("scripts/examples/cleanrl_dqn.py"),
    "errors": reference.error_tree,
}
"""What makes each part of the reference."""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add what lies outside of docs/ (MkDocs' event)."""
    pictures = [path for path in sorted((ROOT / PICTURES).iterdir()) if path.suffix in SUFFIXES]
    for path in [*(ROOT / name for name in PAGES), *pictures]:
        place = place_of(path.relative_to(ROOT).as_posix())
        if place is not None:
            files.append(File.generated(config, place, abs_src_path=str(path)))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001 - MkDocs' names
    """Make what the page asks for, and mend its links (MkDocs' event)."""
    place = page.file.src_uri
    if place == "index.md":  # it has no pages beside it
        page.meta["hide"] = ["navigation"]

    def lost(link: str) -> None:
        LOG.warning(f"{place} links to {link}, which isn't on the site")

    return with_links_of_site(made(markdown), place, lost)


def place_of(file: str) -> str | None:
    """Return where a file, named from the project's root, is on the site; None if it isn't there."""
    path = PurePosixPath(file)
    if file in PAGES:
        return PAGES[file]
    if path.parts[:1] == ("docs",):
        return str(path.relative_to("docs"))
    if str(path.parent) == PICTURES and path.suffix in SUFFIXES:
        return f"pictures/{path.name}"
    return None


def file_of(place: str) -> str:
    """Return the file, named from the project's root, of a page of the site."""
    return next((file for file, at in PAGES.items() if at == place), f"docs/{place}")


def with_links_of_site(markdown: str, place: str, lost: Callable[[str], None]) -> str:
    """Return a page's Markdown with each link to a file of the project turned into one on the site.

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


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001 - MkDocs' names
    """Give a page without sections the room of their list, and keep words of code whole in tables (MkDocs' event)."""
    if not any(heading.children for heading in page.toc):
        page.meta["hide"] = [*page.meta.get("hide", []), "toc"]
    return with_whole_words(html)


def with_whole_words(html: str) -> str:
    """Return the page with each code word in a table in a span: a browser would break it at a hyphen."""
    return _CELL.sub(lambda cell: _CODE.sub(_spans, cell[0]), html)


def _spans(code: re.Match[str]) -> str:
    words = (f'<span class="word">{word}</span>' for word in code[1].split(" "))
    return f"<code>{' '.join(words)}</code>"


def made(markdown: str) -> str:
    """Make each part that a page asks for, and return the page; PluginError if nothing makes one."""
    return MADE.sub(_made, markdown)


def _made(asked: re.Match[str]) -> str:
    maker = MAKERS.get(asked[1])
    if maker is None:
        raise PluginError(f"nothing makes {asked[1]!r}: there is {', '.join(MAKERS)}")
    return maker()
