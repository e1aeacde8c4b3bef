"""What MkDocs asks of the hook: pages that are made, and tables that can be read."""

import pytest
from mkdocs.exceptions import PluginError

from scripts.documentation.hook import MAKERS, made, with_whole_words


@pytest.mark.parametrize("name", MAKERS)
def test_each_part_is_made_where_a_page_asks_for_it(name: str) -> None:
    page = made(f"# Title\n\n<!-- made from the code: {name} -->\n\nThe end.\n")
    assert page.startswith("# Title\n\n")
    assert page.endswith("\n\nThe end.\n")
    assert "<!--" not in page
    assert len(page) > 200


def test_what_nothing_makes_is_an_error_that_names_it() -> None:
    with pytest.raises(PluginError, match="nothing makes 'soup': there is command line, "):
        made("<!-- made from the code: soup -->")


def test_code_in_a_table_ends_a_line_between_words_alone() -> None:
    cell = "<td><code>train --out DIR</code></td>"
    words = '<span class="word">train</span> <span class="word">--out</span> <span class="word">DIR</span>'
    assert with_whole_words(cell) == f"<td><code>{words}</code></td>"
    assert with_whole_words("<p><code>a-b</code></p>") == "<p><code>a-b</code></p>"
