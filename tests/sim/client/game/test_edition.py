import pytest

from sim.client.game.edition import Edition, Layout


@pytest.mark.parametrize(
    ("version", "layout"),
    [
        ("1.8", "1.8-1.12"),
        ("1.12.2", "1.8-1.12"),
        ("1.13", "1.13-1.15"),
        ("1.15.2", "1.13-1.15"),
        ("1.16", "1.16-1.19.2"),
        ("1.19.2", "1.16-1.19.2"),
        ("1.19.3", "1.19.3-1.21.8"),
        ("1.21.8", "1.19.3-1.21.8"),
        ("1.21.9", "1.21.9-26.3"),
        ("26.3", "1.21.9-26.3"),
        ("26.4-snapshot-1", "26.4"),
    ],
)
def test_each_version_has_its_debug_screens_layout(version: str, layout: Layout) -> None:
    assert Edition(version).layout == layout


def test_since_holds_for_a_versions_own_number_and_older_ones() -> None:
    edition = Edition("1.16.4")
    assert edition.since(1, 16)
    assert edition.since(1, 16, 4)
    assert not edition.since(1, 16, 5)
    assert not edition.since(1, 17)
    assert Edition("26.1").since(1, 21, 11)


@pytest.mark.parametrize(
    ("version", "in_world", "title"),
    [
        ("1.14.4", True, "Minecraft 1.14.4"),
        ("1.15", True, "Minecraft 1.15 - Singleplayer"),
        ("1.15", False, "Minecraft 1.15"),
    ],
)
def test_the_title_names_the_state_in_a_world_since_1_15(version: str, in_world: bool, title: str) -> None:
    assert Edition(version).title(in_world=in_world) == title


def test_a_sneaking_player_is_lower_since_1_14() -> None:
    assert Edition("1.13.2").sneaking_height() == (1.65, 1.54)
    assert Edition("1.14").sneaking_height() == (1.5, 1.27)


def test_ids_are_shown_with_their_namespace() -> None:
    assert Edition("1.20.1").shown_id("stone") == "minecraft:stone"
