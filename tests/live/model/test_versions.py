"""Minecraft's versions by their numbers.

What titles say: of the game itself, of loaders, snapshots, packs, and in other languages.
"""

import re

import pytest

from mc_nested.live.model.versions import (
    is_minecrafts,
    later_version_line,
    may_be_shared,
    state_in,
    version_in,
    version_numbers,
)
from mc_nested.live.profile.tables import WindowTable


@pytest.mark.parametrize(
    ("version", "numbers"),
    [
        ("1.21", (1, 21, 0)),
        ("1.21.10", (1, 21, 10)),
        ("26.4-snapshot-1", (26, 4, 0)),
        ("26.1.2", (26, 1, 2)),
        ("1.20.1-forge-47.2.0", (1, 20, 1)),
        ("25w41a", (0, 0, 0)),
        ("", (0, 0, 0)),
    ],
)
def test_a_version_has_three_numbers_that_order_it(version: str, numbers: tuple[int, int, int]) -> None:
    assert version_numbers(version) == numbers


@pytest.mark.parametrize("version", ["1.7.10", "1.12.2", "1.21.11", "26.1", "26.3.1", "26.4-snapshot-1", "27.1"])
def test_known_and_possible_future_versions_are_minecrafts(version: str) -> None:
    assert is_minecrafts(version)


@pytest.mark.parametrize("version", ["1.22", "1.21.12", "1.20.7", "2.0", "3.5.1", "25.1", "26.0", "26.10", "0.15", ""])
def test_version_numbers_that_minecraft_never_has_are_not_minecrafts(version: str) -> None:
    assert not is_minecrafts(version)


@pytest.mark.parametrize(("version", "is_later"), [("1.21", False), ("26.4.9", False), ("26.5", True), ("27.1", True)])
def test_only_a_version_later_than_all_known_ones_has_one_line_about_it(version: str, is_later: bool) -> None:
    line = later_version_line(version)
    assert (line is not None) == is_later
    assert line is None or (line.startswith(f"Minecraft {version} is later than 26.4") and "\n" not in line)


@pytest.mark.parametrize(
    ("title", "version", "state"),
    [
        ("Minecraft 1.12.2", "1.12.2", None),
        ("Minecraft* 26.1 - Multiplayer (LAN)", "26.1", "Multiplayer (LAN)"),
        ("Minecraft 1.21.11-rc1", "1.21.11", None),
        ("Minecraft NeoForge* 1.20.4 - Singleplayer", "1.20.4", "Singleplayer"),
        ("Minecraft Forge* 1.20.1", "1.20.1", None),
        ("Minecraft 26.4-snapshot-1 - Singleplayer", "26.4", "Singleplayer"),
        ("Minecraft 25w41a - Einzelspieler", None, "Einzelspieler"),
        ("Minecraft* 1.20.1 - 单人游戏", "1.20.1", "单人游戏"),
        ("Minecraft: All the Mods 9", None, None),
        ("Minecraft 3.2 - Singleplayer", None, "Singleplayer"),
        ("Minecraft 27.1", "27.1", None),
        ("Prismarine Web Client - Chromium", None, None),
    ],
)
def test_the_title_says_the_version_and_the_worlds_state(title: str, version: str | None, state: str | None) -> None:
    assert (version_in(title), state_in(title)) == (version, state)


@pytest.mark.parametrize(
    "title",
    [
        *("Minecraft 1.20.1", "Minecraft* 1.20.1 - Singleplayer", "Minecraft 1.20.1 - Solo", "All the Mods 9"),
        *("Minecraft 1.17 - Tryb jednoosobowy", "Minecraft Forge* 1.20.1 - シングルプレイ", "My pack - The sequel"),
    ],
)
def test_a_title_that_says_single_player_or_nothing_is_not_shared(title: str) -> None:
    assert not may_be_shared(title)


@pytest.mark.parametrize(
    "title",
    [
        *("Minecraft 1.20.1 - Multiplayer (LAN)", "Minecraft 1.15.2 - Multiplayer (3rd-party)"),
        *("Minecraft 1.20.1 - Multijugador (LAN)", "Minecraft* 1.20.1 - マルチプレイ（LAN）", "Minecraft 25w41a - x"),  # noqa: RUF001 - as the game writes it
        *("My pack - Multiplayer (LAN)", "Minecraft 1.20.1 - Singleplayer (LAN)"),
        *("Minecraft 26.3 - Multiplayer (3rd-party Server)", "Minecraft 26.4 - Multiplayer (Third-party Server)"),
    ],
)
def test_a_title_with_any_other_state_may_be_shared(title: str) -> None:
    assert may_be_shared(title)


@pytest.mark.parametrize(
    "title", ["Minecraft 1.12.2", "Minecraft* 1.20.1 - Solo", "Minecraft NeoForge* 1.20.4", "Minecraft 25w41a"]
)
def test_a_profiles_own_title_finds_the_window(title: str) -> None:
    assert re.search(WindowTable().title, title)


@pytest.mark.parametrize("title", ["Minecraft Launcher", "Minecraft: NeoForge Loading...", "How Minecraft 1.20 works"])
def test_the_default_title_does_not_match_windows_of_other_programs(title: str) -> None:
    assert not re.search(WindowTable().title, title)
