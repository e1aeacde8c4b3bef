"""The hook of MkDocs: generated parts of pages, links between the project's files, and code in tables."""

import pytest
from mkdocs.exceptions import PluginError

from scripts.documentation.hook import MAKERS, file_of, made, place_of, with_links_of_site, with_whole_words


@pytest.mark.parametrize("name", MAKERS)
def test_each_generated_part_replaces_its_marker_in_the_page(name: str) -> None:
    page = made(f"# Title\n\n<!-- made from the code: {name} -->\n\nThe end.\n")
    assert page.startswith("# Title\n\n")
    assert page.endswith("\n\nThe end.\n")
    assert "<!--" not in page
    assert len(page) > 200


def test_marker_of_an_unknown_part_is_an_error_that_names_it() -> None:
    with pytest.raises(PluginError, match="nothing makes 'soup': there is command line, "):
        made("<!-- made from the code: soup -->")


def test_code_in_a_table_is_wrapped_only_between_words() -> None:
    cell = "<td><code>train --out DIR</code></td>"
    words = '<span class="word">train</span> <span class="word">--out</span> <span class="word">DIR</span>'
    assert with_whole_words(cell) == f"<td><code>{words}</code></td>"
    assert with_whole_words("<p><code>a-b</code></p>") == "<p><code>a-b</code></p>"


def moved(markdown: str, place: str) -> tuple[str, list[str]]:
    lost: list[str] = []
    return with_links_of_site(markdown, place, lost.append), lost


def test_pages_and_pictures_have_a_place_on_the_site_and_other_files_have_none() -> None:
    assert place_of("docs/how-to/resume.md") == "how-to/resume.md"
    assert place_of("README.md") == "project/readme.md"
    assert place_of("scripts/map.png") == "pictures/map.png"
    assert place_of("scripts/standin/game.js") is None
    assert place_of("mc_nested/errors.py") is None


def test_file_of_gives_the_file_of_a_place_on_the_site() -> None:
    assert file_of("project/readme.md") == "README.md"
    assert file_of("explanation/facts.md") == "mc_nested/live/FACTS.md"
    assert file_of("how-to/resume.md") == "docs/how-to/resume.md"


def test_link_to_a_file_is_moved_to_its_place_on_the_site() -> None:
    text = "[task](docs/explanation/task.md#past) ![map](scripts/map.png)"
    assert moved(text, "project/readme.md") == ("[task](../explanation/task.md#past) ![map](../pictures/map.png)", [])
    facts = "[walking](../../mc_nested/live/FACTS.md#walking)"
    assert moved(facts, "how-to/resume.md") == ("[walking](../explanation/facts.md#walking)", [])
    assert moved("[next](train-live.md)", "how-to/resume.md") == ("[next](train-live.md)", [])


def test_web_links_anchors_and_code_blocks_stay_unchanged() -> None:
    text = "[web](https://example.org) [below](#end)\n```\n[x](docs/lost.py)\n```\n"
    assert moved(text, "index.md") == (text, [])


def test_link_to_a_file_that_is_not_on_the_site_is_reported() -> None:
    code = "[code](mc_nested/errors.py)"
    assert moved(code, "project/readme.md") == (code, ["mc_nested/errors.py"])
