"""The arena's table: which blocks it covers in the world, and that a reset never clears others."""

import pytest
from pydantic import ValidationError

from mc_nested.arena.scenario import Material, Scenario
from mc_nested.errors import ProfileError
from mc_nested.live.profile.arena import FILL_LIMIT, Arena, size_for
from mc_nested.live.profile.store import parse_profile


@pytest.mark.parametrize(
    ("marked", "complaint"),
    [
        ("[[0, 64, 0], [13, 65, 14]]", "don't hold the whole arena"),
        ("[[0, 63, 0], [-14, 65, 14]]", "into the floor"),
        ("[[0, 64, 0], [-200, 264, 200]]", "more than 32768 blocks"),
    ],
)
def test_a_profile_with_unsuitable_marked_blocks_is_refused(marked: str, complaint: str) -> None:
    with pytest.raises(ProfileError, match=complaint):
        parse_profile(f"[arena]\norigin = [0, 64, 0]\nfacing = 'south'\nmarked = {marked}", "mine.toml")


def test_an_arena_around_an_origin_marks_its_cells_as_high_as_the_player() -> None:
    # Facing south, forward is +z and right is -x: 15 cells reach from x = 5 down to -9, from z = -20 up to -6.
    arena = Arena.around((5, 64, -20), "south")
    assert arena.region == ((-9, 64, -20), (5, 65, -6))
    assert arena.yaw == 0.0
    assert arena.block_of((0, 0)) == (5, 64, -20)
    assert arena.block_of((2, 1)) == (3, 64, -19)
    assert arena.centre_of((2, 1)) == (3.5, 64.0, -18.5)
    assert arena.position_of((3.25, 64.0, -18.5)) == (2.25, 1.0)


def test_arena_without_a_size_in_its_profile_has_15_cells() -> None:
    text = "[arena]\norigin = [0, 64, 0]\nfacing = 'south'\nmarked = [[0, 64, 0], [-14, 65, 14]]"
    assert parse_profile(text, "mine.toml").marked_arena() == Arena.around((0, 64, 0), "south")
    assert Arena.around((0, 64, 0), "south").size == 15


@pytest.mark.parametrize(("size", "is_valid"), [(14, False), (15, True), (32, True), (33, False)])
def test_a_profiles_arena_has_15_to_32_cells_a_side(size: int, is_valid: bool) -> None:
    text = f"[arena]\norigin = [0, 64, 0]\nfacing = 'south'\nsize = {size}\nmarked = [[0, 64, 0], [-40, 65, 40]]"
    if is_valid:
        assert parse_profile(text, "mine.toml").marked_arena().size == size
        return
    with pytest.raises(ProfileError, match=r"arena\.size"):
        parse_profile(text, "mine.toml")


@pytest.mark.parametrize(("needs", "gets"), [(5, 15), (15, 15), (16, 16), (32, 32)])
def test_a_scenario_needs_an_arena_of_its_own_size_but_at_least_15_cells(needs: int, gets: int) -> None:
    assert size_for(Scenario("any", frozenset({(1, 1)}), (0, 0), 9, (Material("stone", 0.0, "stone"),), needs)) == gets


def test_marked_blocks_must_hold_the_arenas_whole_size() -> None:
    arena = Arena.around((0, 64, 0), "south", size=20)
    assert arena.region == ((-19, 64, 0), (0, 65, 19))
    assert (arena.middle, arena.near_middle) == ((10, 10), (10, 0))
    with pytest.raises(ValidationError, match="don't hold the whole arena"):
        Arena(origin=(0, 64, 0), facing="south", size=21, marked=arena.marked)


def test_a_region_starts_with_its_lowest_corner_whichever_corners_are_marked() -> None:
    arena = Arena(origin=(0, 64, 0), facing="south", marked=((2, 64, 20), (-14, 66, -3)))
    assert arena.region == ((-14, 64, -3), (2, 66, 20))


@pytest.mark.parametrize(("height", "is_valid"), [(145, True), (146, False)])
def test_more_marked_blocks_than_one_fill_takes_are_refused(height: int, is_valid: bool) -> None:
    # 15 x 15 cells: 145 high are 32,625 blocks, 146 high are 32,850.
    assert FILL_LIMIT == 32_768
    if is_valid:
        assert Arena.around((0, 64, 0), "north", height).region[1][1] == 64 + height - 1
        return
    with pytest.raises(ValidationError, match="more than 32768 blocks are marked"):
        Arena.around((0, 64, 0), "north", height)


def test_exactly_as_many_marked_blocks_as_one_fill_takes_are_allowed() -> None:
    # 32 x 32 x 32 blocks.
    arena = Arena(origin=(0, 64, 0), facing="south", marked=((-31, 64, 0), (0, 95, 31)))
    assert arena.region == ((-31, 64, 0), (0, 95, 31))


@pytest.mark.parametrize(
    "marked",
    [
        ((-13, 64, 0), (0, 65, 14)),
        ((-14, 64, 0), (-1, 65, 14)),
        ((-14, 64, 1), (0, 65, 14)),
        ((-14, 64, 0), (0, 65, 13)),
        ((-14, 65, 0), (0, 66, 14)),
    ],
)
def test_marked_blocks_that_lack_a_side_of_the_arena_are_refused(
    marked: tuple[tuple[int, int, int], tuple[int, int, int]],
) -> None:
    with pytest.raises(ValidationError, match="don't hold the whole arena"):
        Arena(origin=(0, 64, 0), facing="south", marked=marked)


def test_the_floor_is_never_marked() -> None:
    with pytest.raises(ValidationError, match="into the floor"):
        Arena(origin=(0, 64, 0), facing="south", marked=((-14, 63, 0), (0, 65, 14)))
