"""The built site: no warning, no broken link or anchor, nothing fetched, a page for everything."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urldefrag

import pytest
from typer.core import TyperCommand, TyperGroup, TyperOption

from mc_nested.cli.app import HIDDEN, VERBS, app_with
from scripts.test import ALL
from tests.docs.pages import ROOT, pages

pytestmark = pytest.mark.slow

FETCHED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}
"""What a browser loads by itself, by the attribute that says from where."""


@dataclass
class Page:
    """The content of a page: the targets of its links, the files that it loads, its anchors, and its text."""

    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)
    text: str = ""


class PageReader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.page = Page()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        of = {name: value or "" for name, value in attributes}
        if "id" in of:
            self.page.anchors.add(of["id"])
        if tag == "a" and "href" in of:
            self.page.links.append(of["href"])
        if FETCHED.get(tag, "") in of:
            self.page.loaded.append(of[FETCHED[tag]])

    def handle_data(self, data: str) -> None:
        self.page.text += data


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the site as scripts/test.py builds it."""
    folder = tmp_path_factory.mktemp("site")
    check = ALL["documentation"]
    program, *words = check.command
    command = [sys.executable, "-m", program, *words, "--site-dir", str(folder)]
    environment = {**os.environ, **check.variables}
    built = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    assert "WARNING" not in built.stderr
    return folder


@pytest.fixture(scope="module")
def read(site: Path) -> dict[Path, Page]:
    found = {}
    for path in site.rglob("*.html"):
        reader = PageReader()
        reader.feed(path.read_text("utf-8"))
        found[path] = reader.page
    return found


def is_elsewhere(target: str) -> bool:
    return re.match(r"[a-z]+:|//", target) is not None


def test_every_link_leads_to_a_page_and_to_an_anchor_that_is_there(read: dict[Path, Page]) -> None:
    broken = []
    for path, page in read.items():
        if path.name == "404.html":  # its links are those of a server's root
            continue
        for link in (each for each in page.links if not is_elsewhere(each)):
            target, anchor = urldefrag(unquote(link))
            there = (path.parent / target).resolve() if target else path
            if not there.is_file() or (anchor and there in read and anchor not in read[there].anchors):
                broken.append(f"{path.name}: {link}")
    assert broken == []


def test_site_fetches_nothing_from_other_servers(read: dict[Path, Page], site: Path) -> None:
    elsewhere = [target for page in read.values() for target in page.loaded if is_elsewhere(target)]
    assert elsewhere == []
    own = [path for path in site.rglob("*.css") if "@import" in path.read_text("utf-8")]
    assert own == []
    assert not any(re.search(r"url\(['\"]?(https?:)?//", path.read_text("utf-8")) for path in site.rglob("*.css"))


def test_the_search_can_be_used_without_a_server(site: Path) -> None:
    assert (site / "search" / "search_index.js").is_file()
    assert "iframe-worker" in (site / "reference" / "env.html").read_text("utf-8")
    assert (site / "assets" / "iframe-worker.js").is_file()


def test_every_page_of_the_documentation_is_in_the_navigation(site: Path) -> None:
    listed = (ROOT / "mkdocs.yml").read_text("utf-8")
    built = [path.relative_to(site).with_suffix(".md").as_posix() for path in site.rglob("*.html")]
    assert [page for page in built if page != "404.md" and f": {page}\n" not in listed] == []


def test_every_option_of_every_verb_is_in_the_reference(site: Path) -> None:
    page = (site / "reference" / "command-line.html").read_text("utf-8")
    sections = dict(re.findall(r'<h[2-4] id="([^"]+)">.*?</h[2-4]>(.*?)(?=<h[2-4]|</article>)', page, re.DOTALL))
    missing = [
        f"{words} {name}"
        for words, command in verbs_below("mc-nested", app_with({**VERBS, **HIDDEN}))
        for each in command.params
        if isinstance(each, TyperOption) and not each.hidden
        for name in each.opts
        if name not in sections[words.replace(" ", "-")]
    ]
    assert missing == []
    assert len(sections) >= 18


def verbs_below(words: str, command: Any) -> Iterator[tuple[str, TyperCommand | TyperGroup]]:
    """Yield a verb's words and its command, and those of the verbs below it."""
    yield words, command
    for name, below in getattr(command, "commands", {}).items():
        if not below.hidden:
            yield from verbs_below(f"{words} {name}", below)


def test_readme_is_one_page_that_says_how_to_stop() -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    assert len(readme.splitlines()) <= 90
    assert "**To stop it: press F12" in readme


def test_every_link_to_a_project_file_leads_to_an_existing_file() -> None:
    others = ["ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "mc_nested/live/FACTS.md"]
    broken = []
    for page in [*pages(), *others]:
        text = re.sub(r"```.*?```", "", (ROOT / page).read_text("utf-8"), flags=re.DOTALL)
        targets = [target for target in re.findall(r"\]\(([^)\s#]+)[^)]*\)", text) if not is_elsewhere(target)]
        broken += [f"{page}: {target}" for target in targets if not ((ROOT / page).parent / target).exists()]
    assert broken == []


def test_no_page_contains_merge_conflict_markers() -> None:
    texts = {page: (ROOT / page).read_text("utf-8") for page in pages()}
    assert [page for page, text in texts.items() if re.search("^(<{7}|>{7}) ", text, re.MULTILINE)] == []
