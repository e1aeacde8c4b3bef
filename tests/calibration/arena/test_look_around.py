"""Looking around an arena: where the view is turned, and what is taken for the floor or for something in the way."""

import math

import pytest

from calibration.arena.look_around import cells_to_look_at, is_in_sight, look_around, look_at, teleport_and_look
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.profile.arena import Arena
from tests.calibration.arena.scripted import ScriptedConsole

ARENA = Arena.around((7, 64, 0), "south")


def sees(target: Target | None, off: tuple[float, float] = (0.0, 0.0)) -> ScriptedConsole:
    def respond(command: str) -> Reading:
        yaw, pitch = (float(part) for part in command.split()[-2:])
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=yaw + off[0], pitch=pitch + off[1], target=target)

    return ScriptedConsole(respond)


def test_the_view_is_turned_from_the_eyes_to_the_point() -> None:
    console = sees(None)
    # 3 blocks east, 4 south, at the height of the feet: 5 blocks away, the eyes 1.62 above.
    look_at(console, (3.5, 64.0, 4.5))
    yaw, pitch = -math.degrees(math.atan2(3, 4)), math.degrees(math.atan2(1.62, 5))
    assert console.sent == [f"/tp @s ~ ~ ~ {yaw:.1f} {pitch:.1f}"] == ["/tp @s ~ ~ ~ -36.9 18.0"]


def test_a_higher_point_is_looked_up_to() -> None:
    console = sees(None)
    look_at(console, (0.5, 64.0 + 1.62 + 4, -3.5))
    assert console.sent in (["/tp @s ~ ~ ~ -180.0 -45.0"], ["/tp @s ~ ~ ~ 180.0 -45.0"])


@pytest.mark.parametrize(
    ("off", "is_seen"),
    [((0.1, 0.1), True), ((0.5, 0.0), False), ((-0.5, 0.0), False), ((0.0, 0.5), False), ((0.0, -0.5), False)],
)
def test_a_block_counts_once_the_view_is_there(off: tuple[float, float], is_seen: bool) -> None:
    stone = Target((1, 2, 3), "minecraft:stone")
    seen = teleport_and_look(sees(stone, off), "1 2 3 90 45", 90.0, 45.0)
    assert seen == (stone if is_seen else None)


def test_a_view_is_there_up_to_two_tenths_of_a_degree() -> None:
    stone = Target((1, 2, 3), "minecraft:stone")
    assert teleport_and_look(sees(stone, (0.2, 0.2)), "1 2 3 0 0", 0.0, 0.0) == stone
    assert teleport_and_look(sees(stone, (0.3, 0.0)), "1 2 3 0 0", 0.0, 0.0) is None
    assert teleport_and_look(sees(stone, (0.0, 0.3)), "1 2 3 0 0", 0.0, 0.0) is None


def test_a_view_that_can_not_be_read_is_not_there() -> None:
    blind = Reading(xyz=(0.5, 64.0, 0.5))
    assert teleport_and_look(ScriptedConsole(lambda _: blind), "~ ~ ~ 0 0", 0.0, 0.0) is None


def test_every_look_sees_the_floor_of_its_own_cell() -> None:
    floors = iter([ARENA.block_of(cell) for cell in cells_to_look_at(15)])

    def respond(command: str) -> Reading:
        yaw, pitch = (float(part) for part in command.split()[-2:])
        x, y, z = next(floors)
        return Reading(xyz=(0.5, 64.0, 0.5), yaw=yaw, pitch=pitch, target=Target((x, y - 1, z), "minecraft:stone"))

    seen = look_around(ScriptedConsole(respond), ARENA, (7, 0))
    assert (seen.in_the_way, seen.floor, seen.looks) == ({}, 15, 15)


@pytest.mark.parametrize(
    ("target", "in_the_way"),
    [
        (Target((3, 64, 5), "minecraft:dirt"), {(3, 64, 5): "minecraft:dirt"}),
        (Target((3, 65, 5), None), {(3, 65, 5): "a block"}),
        (Target((3, 63, 500), "minecraft:dirt"), {}),
        (Target(None, "minecraft:dirt"), {}),
        (None, {}),
    ],
)
def test_blocks_from_the_level_of_the_feet_up_are_in_the_way(
    target: Target | None, in_the_way: dict[tuple[int, int, int], str]
) -> None:
    seen = look_around(sees(target), ARENA, (7, 0))
    assert (seen.in_the_way, seen.floor, seen.looks) == (in_the_way, 0, 15)


def test_of_an_arena_of_15_cells_all_that_is_looked_at_is_in_sight_from_every_cell() -> None:
    assert cells_to_look_at(15) == [(x, y) for y in (3, 8, 13) for x in (1, 4, 7, 10, 13)]
    corners = [(0, 0), (14, 0), (0, 14), (14, 14)]
    assert all(is_in_sight(cell, corner) for cell in cells_to_look_at(15) for corner in corners)


@pytest.mark.parametrize(("cell", "is_seen"), [((16, 19), True), ((16, 20), False), ((0, 11), True), ((0, 12), False)])
def test_a_floor_is_in_sight_where_the_game_names_its_block(cell: tuple[int, int], is_seen: bool) -> None:
    # From (16, 0), eyes 1.62 up: 19.07 and 20.07, 19.48 and 20.06 blocks away.
    assert is_in_sight(cell, (16, 0)) is is_seen


@pytest.mark.parametrize(("size", "looks"), [(20, 15), (32, 8)])
def test_what_is_out_of_sight_is_counted_and_not_looked_at(size: int, looks: int) -> None:
    arena = Arena.around((7, 64, 0), "south", size=size)
    console = sees(None)
    seen = look_around(console, arena, arena.near_middle)
    assert len(cells_to_look_at(size)) == 15
    assert (seen.looks, seen.out_of_sight, len(console.sent)) == (looks, 15 - looks, looks)
