"""Finding the game's window among all windows, and checks of its client area."""

import re

import pytest

from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.desktop.window import TitledWindow, check_shown, closed_error, game_window, is_within
from mc_nested.live.devices import DesktopArea
from mc_nested.live.model.versions import GAME_TITLE

TAB = "Minecraft 1.20.1 release notes - Mozilla Firefox"


def found(title: str, titles: list[str]) -> int:
    return game_window(title, [TitledWindow(each) for each in titles])


@pytest.mark.parametrize(
    "title", ["Minecraft 1.12.2", "Minecraft* 1.20.1 - Singleplayer", "Minecraft 26.1 - Multiplayer (LAN)"]
)
def test_the_game_is_found_among_other_windows_whatever_its_state(title: str) -> None:
    assert found(GAME_TITLE, ["Minecraft Wiki - Firefox", title, "Minecraft Launcher"]) == 1


@pytest.mark.parametrize(
    "program",
    [
        *("Navigator firefox", "google-chrome Google-chrome", "firefox.exe MozillaWindowClass", "msedge.exe", "Safari"),
        *("minecraft-launcher Minecraft Launcher", "prismlauncher org.prismlauncher.PrismLauncher", "opera Opera"),
    ],
)
def test_a_browser_or_launcher_window_is_never_taken_for_the_game(program: str) -> None:
    windows = [TitledWindow(TAB, program), TitledWindow("Minecraft 1.20.1", "Minecraft 1.20.1 Minecraft 1.20.1")]
    assert game_window(GAME_TITLE, windows) == 1
    with pytest.raises(NoWindowError, match=re.escape(f"{TAB!r} (of {program})")):
        game_window(GAME_TITLE, windows[:1])


@pytest.mark.parametrize(
    "program", ["", "javaw.exe GLFW30", "java", "python3 Minecraft 1.20.1", "net-minecraft-Opera2"]
)
def test_a_window_of_any_other_program_may_be_the_game(program: str) -> None:
    assert game_window(GAME_TITLE, [TitledWindow("Minecraft 1.20.1", program)]) == 0


def test_a_browser_window_is_found_by_a_title_that_the_player_chose() -> None:
    assert game_window("Web Client", [TitledWindow("Prismarine Web Client", "chromium Chromium")]) == 0


def test_a_game_with_another_title_is_an_error_that_says_how_to_name_it() -> None:
    with pytest.raises(NoWindowError, match=r"title = 'Lunar Client' under \[window\].*'Lunar Client 1\.21\.4'"):
        found(GAME_TITLE, ["Lunar Client 1.21.4", "Terminal"])
    assert found("Lunar Client", ["Lunar Client 1.21.4", "Terminal"]) == 0


def test_a_game_that_is_loading_is_waited_for() -> None:
    with pytest.raises(NoWindowError, match="the game is still loading: wait"):
        found(GAME_TITLE, ["Minecraft: NeoForge Loading..."])


def test_a_missing_window_is_an_error_that_names_titles_that_exist() -> None:
    with pytest.raises(
        NoWindowError, match=r"^no window of the game is open: start the game.*'Minecraft Launcher', 'Terminal'"
    ):
        found(GAME_TITLE, ["Terminal", "", "Minecraft Launcher"])


def test_an_error_names_no_more_titles_than_fit_into_a_line() -> None:
    with pytest.raises(DesktopError, match=r"'tab 07' and 22 more$"):
        found(GAME_TITLE, [f"tab {number:02}" for number in range(30)])


def test_two_windows_with_a_matching_title_are_an_error_that_names_both() -> None:
    with pytest.raises(DesktopError, match=r"2 windows.*'Minecraft 1\.20\.1', 'Minecraft 1\.21'") as raised:
        found(GAME_TITLE, ["Minecraft 1.21", "Terminal", "Minecraft 1.20.1"])
    assert not isinstance(raised.value, NoWindowError)


@pytest.mark.parametrize("size", [(0, 480), (854, 0)])
def test_a_window_without_area_counts_as_minimised(size: tuple[int, int]) -> None:
    with pytest.raises(DesktopError, match="minimised"):
        check_shown(DesktopArea(0, 0, *size), "Minecraft 1.21")


def test_the_smallest_window_with_an_area_is_shown() -> None:
    check_shown(DesktopArea(0, 0, 1, 1), "Minecraft 1.21")


def test_the_error_says_none_on_a_desktop_without_titles() -> None:
    with pytest.raises(NoWindowError, match=r"windows on this desktop: none$"):
        found(GAME_TITLE, ["", ""])


def test_the_error_names_all_of_eight_titles() -> None:
    titles = [f"tab {number}" for number in range(8)]
    with pytest.raises(NoWindowError, match=r"'tab 7'$"):
        found(GAME_TITLE, titles)


def test_the_error_about_a_closed_window_names_it() -> None:
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
def test_an_area_is_within_another_if_no_edge_lies_beyond_it(area: DesktopArea, is_inside: bool) -> None:
    assert is_within(area, DesktopArea(-5, 0, 10, 20)) == is_inside
