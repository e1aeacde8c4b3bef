"""The debug options: which entries are listed, and where their buttons stand."""

import pytest

from sim.client.game.debug_entries import GAME_DEFAULT, known_entries
from sim.client.game.debug_options import choices, debug_options
from sim.client.game.edition import Edition
from sim.client.game.widgets import EntryChange, Menu, Widget

WIDTH, HEIGHT = 480, 270


def shown(version: str, searched: str = "", height: int = HEIGHT) -> Menu:
    edition = Edition(version)
    return debug_options(choices(GAME_DEFAULT, edition, searched), searched, edition, WIDTH, height)


def buttons_of(menu: Menu, entry: str) -> list[Widget]:
    return [each for each in menu.buttons if isinstance(each.does, EntryChange) and each.does.entry == entry]


def test_every_entry_is_listed_the_texts_first_and_by_their_ids() -> None:
    edition = Edition("26.3")
    listed = [entry for entry, _ in choices(GAME_DEFAULT, edition, "")]
    assert sorted(listed) == list(known_entries(edition))
    texts, drawn = listed[: listed.index("3d_crosshair")], listed[listed.index("3d_crosshair") :]
    assert (texts, drawn) == (sorted(texts), sorted(drawn))
    assert {"biome", "fps", "looking_at_block_state", "tps"} < set(texts)
    assert {"chunk_borders", "visualize_heightmap"} < set(drawn)


def test_a_search_keeps_only_entries_whose_ids_contain_the_text() -> None:
    assert dict(choices(GAME_DEFAULT, Edition("1.21.9"), "looking_at_b")) == {"looking_at_block": "never"}
    assert dict(choices(GAME_DEFAULT, Edition("26.1"), "tp")) == {"tps": "inOverlay"}


@pytest.mark.parametrize(
    ("version", "left", "button", "label"), [("1.21.10", 87, 44, "In F3"), ("1.21.11", 67, 60, "In Overlay")]
)
def test_a_row_has_its_name_at_the_left_and_three_buttons_at_the_right(
    version: str, left: int, button: int, label: str
) -> None:
    menu = shown(version, "fps")
    row = 61 + 2 + 20
    assert [(text.text, text.left, text.top) for text in menu.texts if text.text == "fps" and not text.is_centred][
        -1:
    ] == [("fps", left, row + 7)]
    off, overlay, always = buttons_of(menu, "fps")
    assert [each.label for each in (off, overlay, always)] == ["OFF", label, "Always"]
    assert [each.left for each in (off, overlay, always)] == [WIDTH - left - back * button for back in (3, 2, 1)]
    assert {(each.top, each.width, each.height) for each in (off, overlay, always)} == {(row + 2, button, 16)}
    assert [each.is_active for each in (off, overlay, always)] == [True, False, True]


@pytest.mark.parametrize("height", [240, 270, 360])
def test_rows_without_room_in_the_list_are_left_out(height: int) -> None:
    menu = shown("26.3", height=height)
    rows = {each.top for each in menu.buttons if isinstance(each.does, EntryChange)}
    assert len(rows) == (height - 61 - 33 - 2) // 20 - 1
    assert max(rows) + 16 <= height - 33


def test_the_footer_has_the_profiles_and_done_and_since_26_3_the_scale() -> None:
    for version, labels in (
        ("26.2", ["Default profile", "Performance profile", "Done"]),
        ("26.3", ["Default profile", "Performance profile", "Debug GUI Scale", "Done"]),
    ):
        footer = [each for each in shown(version).buttons if not isinstance(each.does, EntryChange)]
        assert [each.label for each in footer] == labels
        assert footer[0].left + footer[-1].left + footer[-1].width in (WIDTH, WIDTH + 1, WIDTH - 1)
