"""The survey of the ground: free, flat, where a copy can lie, and what stays unknown."""

import pytest

from calibration.arena.ground_survey import GroundSurvey, is_copy_gone, survey_ground
from calibration.arena.plan import box_at
from mc_nested.errors import UserError
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.built_arena import box_of
from mc_nested.live.profile.tables import GameVersion, Profile
from tests.calibration.arena.scripted import ScriptedConsole, ScriptedQueries, looks

ARENA = Arena.around((7, 64, 0), "south")
FIRST, SECOND = (-8, 127, -1), (-8, 95, -1)
"""The lowest corners of the copies 64 and 32 blocks above the floor, which is at 63."""


def console(target: Target | None) -> ScriptedConsole:
    def respond(command: str) -> Reading:
        yaw, pitch = (float(part) for part in command.split()[-2:])
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=yaw, pitch=pitch, target=target)

    return ScriptedConsole(respond)


def survey(queries: ScriptedQueries, version: str = "1.20.1", target: str = "minecraft:grass_block") -> GroundSurvey:
    profile = Profile(game=GameVersion(version=version))
    return survey_ground(console(Target((0, 63, 1), target)), queries, profile, ARENA, ARENA.near_middle)


def test_free_and_flat_ground_is_copied_highest_and_not_looked_around_on() -> None:
    queries = ScriptedQueries()
    ground = survey(queries)
    assert ground == GroundSurvey(True, True, "grass_block", FIRST, None)
    assert ground.keeps_floor
    # The air above the copy's floor, its border left out, is what the region is compared with.
    assert queries.compared[-1] == (ARENA.region, (-7, 128, 0))


@pytest.mark.parametrize(
    ("air", "alike"),
    [({FIRST: False}, {}), ({FIRST: None}, {}), ({}, {(-8, 130, -1): False}), ({}, {(-8, 130, -1): None})],
)
def test_a_copy_lies_where_its_corner_is_air_and_it_equals_the_box_above(
    air: dict[tuple[int, int, int], bool | None], alike: dict[tuple[int, int, int], bool | None]
) -> None:
    assert survey(ScriptedQueries(air, alike)).copy_to == SECOND


def test_without_any_room_in_the_sky_nothing_is_copied_and_whether_it_is_free_is_unknown() -> None:
    below = ARENA.block_of(ARENA.near_middle)
    ground = survey(ScriptedQueries({below: True}, otherwise=False))
    assert (ground.is_free, ground.is_flat, ground.copy_to) == (None, True, None)
    assert ground.view is not None


def test_a_game_that_answers_nothing_leaves_all_of_it_unknown() -> None:
    ground = survey(ScriptedQueries(otherwise=None, uniform=None))
    assert (ground.is_free, ground.is_flat, ground.copy_to) == (None, None, None)
    assert not ground.keeps_floor


def test_ground_that_is_not_loaded_is_an_error_except_in_1_12_which_can_not_say() -> None:
    with pytest.raises(UserError, match="isn't loaded"):
        survey(ScriptedQueries(uniform=None))
    assert survey(ScriptedQueries(uniform=None), "1.12.2").is_flat is None


@pytest.mark.parametrize(("uniform", "is_free"), [(False, True), (True, False)])
def test_ground_that_is_uneven_or_occupied_is_looked_around_on(uniform: bool, is_free: bool) -> None:
    queries = ScriptedQueries(alike={(-7, 128, 0): is_free}, uniform=uniform)
    ground = survey(queries)
    assert (ground.is_flat, ground.is_free) == (uniform, is_free)
    assert ground.view is not None
    assert ground.view.looks == 15


def test_a_slippery_floor_does_not_stay() -> None:
    assert not survey(ScriptedQueries(), target="minecraft:blue_ice").keeps_floor


@pytest.mark.parametrize("target", [None, Target((0, 63, 1), None)])
@pytest.mark.parametrize(
    ("version", "remedy"),
    [
        ("1.20.1", "stand on solid ground"),
        ("1.21.10", "set looking_at_block to In F3$"),
        ("26.3", "set looking_at_block_state to In Overlay$"),
    ],
)
def test_a_block_that_is_not_seen_or_has_no_name_ends_it(target: Target | None, version: str, remedy: str) -> None:
    screen, profile = console(target), Profile(game=GameVersion(version=version))
    with pytest.raises(UserError, match=f"names no block, though the ground is looked at: .*{remedy}"):
        survey_ground(screen, ScriptedQueries(), profile, ARENA, ARENA.near_middle)
    assert len(looks(screen.sent)) == 1


def test_a_teleport_without_an_effect_asks_for_cheats() -> None:
    screen = ScriptedConsole(lambda _: Reading(xyz=(0.5, 64.0, 0.5), yaw=0.0, pitch=0.0))
    with pytest.raises(UserError, match="a teleport had no effect: allow cheats"):
        survey_ground(screen, ScriptedQueries(), Profile(), ARENA, ARENA.near_middle)


def test_a_copy_is_gone_where_there_is_only_air_as_above_it() -> None:
    with_copy = ARENA.model_copy(update={"copied_to": FIRST})
    assert is_copy_gone(ScriptedQueries(otherwise=None), ARENA), "none was ever made"
    queries = ScriptedQueries()
    assert is_copy_gone(queries, with_copy)
    assert queries.compared == [(box_at(box_of(ARENA), FIRST), (-8, 130, -1))]
    assert not is_copy_gone(ScriptedQueries(otherwise=False), with_copy)
    assert not is_copy_gone(ScriptedQueries(otherwise=None), with_copy)
    assert not is_copy_gone(ScriptedQueries(alike={(-8, 130, -1): False}), with_copy), "a hole in the copied floor"
    # Under the player's cell (7, 0), which is at x = 0, z = 0, one block of the copy's floor.
    assert not is_copy_gone(ScriptedQueries({(0, 127, 0): False}), with_copy)
