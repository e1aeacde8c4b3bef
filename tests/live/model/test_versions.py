"""Minecraft's versions by their numbers."""

import pytest

from mc_nested.live.model.versions import is_minecrafts, later_version_line, version_numbers


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
def test_versions_that_minecraft_has_or_may_come_to_have(version: str) -> None:
    assert is_minecrafts(version)


@pytest.mark.parametrize("version", ["1.22", "1.21.12", "1.20.7", "2.0", "3.5.1", "25.1", "26.0", "26.10", "0.15", ""])
def test_versions_that_are_none_of_minecrafts(version: str) -> None:
    assert not is_minecrafts(version)


@pytest.mark.parametrize(("version", "is_later"), [("1.21", False), ("26.4.9", False), ("26.5", True), ("27.1", True)])
def test_a_version_later_than_all_that_are_known_is_played_with_one_line_about_it(version: str, is_later: bool) -> None:
    line = later_version_line(version)
    assert (line is not None) == is_later
    assert line is None or (line.startswith(f"Minecraft {version} is later than 26.4") and "\n" not in line)
