"""Which window is the game's, and what its client area must be."""

import pytest

from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.desktop.window import check_shown, closed_error, is_within, matching_title
from mc_nested.live.devices import DesktopArea

MINECRAFT = r"^Minecraft\*? \d"


@pytest.mark.parametrize(
    "title", ["Minecraft 1.12.2", "Minecraft* 1.20.1 - Singleplayer", "Minecraft 26.1 - Multiplayer (LAN)"]
)
def test_the_game_is_found_among_other_windows_whatever_its_state(title: str) -> None:
    assert matching_title(MINECRAFT, ["Minecraft Wiki - Firefox", title, "Minecraft Launcher"]) == 1


def test_a_missing_window_is_an_error_that_names_titles_that_exist() -> None:
    with pytest.raises(NoWindowError, match=r"start the game.*'Minecraft Launcher', 'Terminal'"):
        matching_title(MINECRAFT, ["Terminal", "", "Minecraft Launcher"])


def test_an_error_names_no_more_titles_than_fit_into_a_line() -> None:
    with pytest.raises(DesktopError, match=r"'tab 07' and 22 more$"):
        matching_title(MINECRAFT, [f"tab {number:02}" for number in range(30)])


def test_two_windows_of_the_title_are_an_error_that_names_both() -> None:
    with pytest.raises(DesktopError, match=r"2 windows.*'Minecraft 1\.20\.1', 'Minecraft 1\.21'") as raised:
        matching_title(MINECRAFT, ["Minecraft 1.21", "Terminal", "Minecraft 1.20.1"])
    assert not isinstance(raised.value, NoWindowError)


@pytest.mark.parametrize("size", [(0, 480), (854, 0)])
def test_a_window_without_area_counts_as_minimised(size: tuple[int, int]) -> None:
    with pytest.raises(DesktopError, match="minimised"):
        check_shown(DesktopArea(0, 0, *size), "Minecraft 1.21")


def test_the_smallest_window_with_an_area_is_shown() -> None:
    check_shown(DesktopArea(0, 0, 1, 1), "Minecraft 1.21")


def test_a_desktop_without_titles_names_none() -> None:
    with pytest.raises(NoWindowError, match=r"windows on this desktop: none$"):
        matching_title(MINECRAFT, ["", ""])


def test_eight_titles_are_all_named() -> None:
    titles = [f"tab {number}" for number in range(8)]
    with pytest.raises(NoWindowError, match=r"'tab 7'$"):
        matching_title(MINECRAFT, titles)


def test_a_closed_window_is_named() -> None:
    assert str(closed_error("Minecraft 1.21")) == "the window 'Minecraft 1.21' has closed: start the game again"


@pytest.mark.parametrize(
    ("area", "is_inside"),
    [
        (DesktopArea(-5, 0, 10, 20), True),
        (DesktopArea(0, 5, 2, 3), True),
        (DesktopArea(-6, 0, 2, 3), False),
        (DesktopArea(0, -1, 2, 3), False),
        (DesktopArea(4, 0, 2, 3), False),
        (DesktopArea(0, 18, 2, 3), False),
    ],
)
def test_an_area_is_within_another_where_none_of_its_edges_is_beyond_it(area: DesktopArea, is_inside: bool) -> None:
    assert is_within(area, DesktopArea(-5, 0, 10, 20)) == is_inside
