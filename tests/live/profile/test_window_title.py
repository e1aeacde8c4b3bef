"""What titles say: of the game itself, of loaders, snapshots, packs, and in other languages."""

import pytest

from mc_nested.live.profile.tables import WindowTable
from mc_nested.live.profile.window_title import may_be_shared, state_in, version_in


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
def test_a_title_of_ones_own_world_or_without_a_state_is_not_shared(title: str) -> None:
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
def test_any_other_state_may_be_a_shared_world_in_every_language(title: str) -> None:
    assert may_be_shared(title)


@pytest.mark.parametrize(
    "title", ["Minecraft 1.12.2", "Minecraft* 1.20.1 - Solo", "Minecraft NeoForge* 1.20.4", "Minecraft 25w41a"]
)
def test_a_profiles_own_title_finds_the_window(title: str) -> None:
    assert WindowTable().matches(title)


@pytest.mark.parametrize("title", ["Minecraft Launcher", "Minecraft: NeoForge Loading...", "How Minecraft 1.20 works"])
def test_other_windows_are_not_the_games(title: str) -> None:
    assert not WindowTable().matches(title)
