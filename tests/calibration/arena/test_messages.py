"""The question before an arena is built, and the summary after it."""

import pytest

from calibration.arena.ground_survey import GroundSurvey
from calibration.arena.look_around import LookAroundResult
from calibration.arena.messages import build_question, build_summary, undo_hint
from mc_nested.live.profile.arena import Arena

ARENA = Arena.around((7, 64, 0), "south")
COPIED = ARENA.model_copy(update={"copied_to": (-8, 127, -1)})
FREE = GroundSurvey(True, True, "grass_block", (-8, 127, -1))


def test_free_ground_is_described_whole() -> None:
    assert build_question(ARENA, FREE, None, ("stone", "planks")) == (
        "Build the arena from (-7, 64, 0) to (7, 65, 14), facing south? There is only air. "
        "The floor, grass_block, is flat: it stays. "
        "Every reset will remove all blocks of these two layers; around them comes a border of lapis_block. "
        "Time, weather and mobs stand still, the game mode is creative, and the first 2 slots of the hotbar are "
        "overwritten. What stands there is copied to (-8, 127, -1) first, and --undo puts it back."
    )


def test_what_was_seen_in_the_way_is_named_six_blocks_at_most() -> None:
    in_the_way = {(x, 64, 3): "dirt" for x in range(8)}
    ground = GroundSurvey(False, False, "ice", (-8, 127, -1), LookAroundResult(in_the_way, 4, 15))
    asked = build_question(ARENA, ground, None, ())
    assert asked.count("dirt at") == 6
    assert "Something stands there (dirt at (0, 64, 3), " in asked
    assert "dirt at (5, 64, 3), 4 of 15 looks saw the floor)." in asked
    assert "The floor, ice, is not of one block: it is replaced by obsidian." in asked


def test_cells_that_were_out_of_sight_are_counted() -> None:
    ground = GroundSurvey(None, None, "stone", None, LookAroundResult({}, 9, 10, 5))
    asked = build_question(Arena.around((7, 64, 0), "south", size=32), ground, None, ())
    assert "What stands there is not known (9 of 10 looks saw the floor, 5 more cells are out of sight)." in asked


def test_ground_that_is_unknown_is_said_to_be() -> None:
    asked = build_question(ARENA, GroundSurvey(None, None, "sand", None), None, ())
    assert "What stands there is not known." in asked
    assert "may have holes" in asked
    assert "this can't be undone" in asked


@pytest.mark.parametrize(
    ("arena", "old", "is_forgotten", "is_final"),
    [
        (ARENA, COPIED, True, True),
        (COPIED, COPIED, False, False),
        (ARENA, ARENA, False, True),
        (ARENA, None, False, True),
    ],
)
def test_the_copy_of_an_arena_before_is_forgotten_unless_it_is_kept(
    arena: Arena, old: Arena | None, is_forgotten: bool, is_final: bool
) -> None:
    asked = build_question(arena, GroundSurvey(True, True, "stone", None), old, ())
    assert ("will be forgotten" in asked) == is_forgotten
    assert ("can't be undone" in asked) == is_final


def test_the_hint_is_the_command_that_copies_it_back() -> None:
    assert undo_hint(ARENA) == "No copy was kept"
    assert undo_hint(COPIED) == "What stood there comes back with /clone -8 127 -1 8 129 15 -8 63 -1"


def test_the_summary_says_what_became_of_floor_and_copy() -> None:
    first, second = build_summary(COPIED, FREE, "mc-nested undo")
    assert first == (
        "Arena from (-7, 64, 0) to (7, 65, 14), facing south; the floor of grass_block stayed, "
        "the border was seen on all four sides."
    )
    assert second == "What stood there is copied to (-8, 127, -1): mc-nested undo puts it back."
    built = build_summary(ARENA, GroundSurvey(True, False, "grass_block", None), "undo")
    assert "the floor is obsidian" in built[0]
    assert built[1].startswith("No copy was kept")
