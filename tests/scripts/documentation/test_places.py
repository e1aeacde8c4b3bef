"""Links between files of the project, on the site."""

from scripts.documentation.places import file_of, place_of, with_links_of_site


def moved(markdown: str, place: str) -> tuple[str, list[str]]:
    lost: list[str] = []
    return with_links_of_site(markdown, place, lost.append), lost


def test_pages_pictures_and_what_lies_elsewhere_have_their_place() -> None:
    assert place_of("docs/how-to/resume.md") == "how-to/resume.md"
    assert place_of("README.md") == "project/readme.md"
    assert place_of("scripts/map.png") == "pictures/map.png"
    assert place_of("scripts/standin/game.js") is None
    assert place_of("mc_nested/errors.py") is None


def test_the_file_of_a_place_is_where_its_links_begin() -> None:
    assert file_of("project/readme.md") == "README.md"
    assert file_of("explanation/facts.md") == "mc_nested/live/FACTS.md"
    assert file_of("how-to/resume.md") == "docs/how-to/resume.md"


def test_a_link_to_a_file_leads_to_its_place() -> None:
    text = "[task](docs/explanation/task.md#past) ![map](scripts/map.png)"
    assert moved(text, "project/readme.md") == ("[task](../explanation/task.md#past) ![map](../pictures/map.png)", [])
    facts = "[walking](../../mc_nested/live/FACTS.md#walking)"
    assert moved(facts, "how-to/resume.md") == ("[walking](../explanation/facts.md#walking)", [])
    assert moved("[next](train-live.md)", "how-to/resume.md") == ("[next](train-live.md)", [])


def test_a_link_elsewhere_an_anchor_and_a_block_of_code_stay() -> None:
    text = "[web](https://example.org) [below](#end)\n```\n[x](docs/lost.py)\n```\n"
    assert moved(text, "index.md") == (text, [])


def test_a_link_to_what_is_not_on_the_site_is_told() -> None:
    code = "[code](mc_nested/errors.py)"
    assert moved(code, "project/readme.md") == (code, ["mc_nested/errors.py"])
