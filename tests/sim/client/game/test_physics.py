"""Players in one world: each is as solid to the others as a block."""

import math
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scripts.benches.walked import displacement
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.physics import (
    AT_REST,
    INPUT,
    SPRINT_WINDOW,
    Gait,
    Gaits,
    Ground,
    Vector,
    is_free,
    kept_apart,
    overlaps,
    step,
    touches,
    wish,
)
from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import VirtualWorld

INERTIA = 0.546
PUSH = 0.98 * 0.1 * 0.1627714 / INERTIA**3
ticks = st.integers(1, 60)


def covered(held: int, push: float) -> float:
    """Return the same way as two geometric series: setting off, then coasting while the step is 0.003 or more."""
    setting_off = sum(push * (1 - INERTIA**tick) / (1 - INERTIA) for tick in range(1, held + 1))
    last = push * (1 - INERTIA**held) / (1 - INERTIA)
    coasting = math.floor(math.log(0.003 / last) / math.log(INERTIA))
    return setting_off + last * INERTIA * (1 - INERTIA**coasting) / (1 - INERTIA)


def is_floor(_x: int, y: int, _z: int) -> bool:
    return y < 64


@pytest.mark.parametrize("held", range(1, 31))
@pytest.mark.parametrize(("gait", "factor"), [("walk", 1.0), ("sneak", 0.3)])
def test_a_hold_and_its_coasting_are_two_geometric_series(held: int, gait: Gait, factor: float) -> None:
    assert displacement(held, gait) == pytest.approx(covered(held, PUSH * factor), abs=1e-9)


def test_holds_cover_the_distances_in_the_facts() -> None:
    assert [round(displacement(held, "walk"), 3) for held in range(1, 7)] == [0.210, 0.427, 0.642, 0.857, 1.073, 1.291]
    assert displacement(0, "walk") == 0


@given(ticks, st.sampled_from(["walk", "sneak"]), st.sampled_from([0.0, 90.0, 180.0, -90.0]))
def test_steps_without_obstacles_add_up_to_the_displacement(held: int, gait: Gait, yaw: float) -> None:
    feet, velocity, stands = (0.5, 64.0, 0.5), AT_REST, True
    for tick in range(held + 30):
        push = wish(tick < held, 0, gait, yaw)
        feet, velocity, stands = step(feet, velocity, push, 1.8, is_floor, on_ground=stands)
    assert stands
    assert feet[1] == 64.0
    assert math.dist((0.5, 0.5), (feet[0], feet[2])) == pytest.approx(displacement(held, gait), abs=1e-9)


@given(st.sampled_from([0.0, 90.0, 180.0, -90.0]), st.floats(-0.19, 0.19))
def test_a_wall_stops_a_walker_at_its_face(yaw: float, start: float) -> None:
    east, south = -round(math.sin(math.radians(yaw))), round(math.cos(math.radians(yaw)))
    feet, velocity, stands = (0.5 + east * start, 64.0, 0.5 + south * start), AT_REST, True

    def is_solid(x: int, y: int, z: int) -> bool:
        return y < 64 or ((x, z) == (east, south) and y == 64)

    for _ in range(40):
        feet, velocity, stands = step(feet, velocity, wish(1, 0, "walk", yaw), 1.8, is_solid, on_ground=stands)
        assert is_free(feet, 1.8, is_solid)
    along = (feet[0] - 0.5) * east + (feet[2] - 0.5) * south
    assert along == pytest.approx(0.2, abs=1e-6)


@given(st.floats(-5, 5), st.floats(-5, 5), st.lists(st.tuples(st.integers(-1, 1), st.integers(-1, 1)), max_size=40))
def test_a_player_never_walks_into_a_block(x: float, z: float, keys: list[tuple[int, int]]) -> None:
    def is_solid(block_x: int, y: int, block_z: int) -> bool:
        return y < 64 or (y == 64 and (block_x * 7 + block_z * 3) % 5 == 0)

    feet, velocity, stands = (x, 66.0, z), (0.0, 0.0, 0.0), False
    for forward, left in keys:
        feet, velocity, stands = step(
            feet, velocity, wish(forward, left, "walk", 30.0), 1.8, is_solid, on_ground=stands
        )
        assert is_free(feet, 1.8, is_solid)


def test_a_fall_ends_on_the_floor() -> None:
    feet, velocity, stands = (0.5, 70.0, 0.5), (0.0, 0.0, 0.0), False
    heights = []
    while not stands:
        feet, velocity, stands = step(feet, velocity, (0.0, 0.0), 1.8, is_floor, on_ground=stands)
        heights.append(feet[1])
    assert heights[1] == pytest.approx(70 - 0.0784)
    assert heights == sorted(heights, reverse=True)
    assert feet == (0.5, 64.0, 0.5)


@pytest.mark.parametrize(("z", "touches"), [(0.69, False), (0.71, True)])
def test_a_player_overlaps_the_next_block_from_0_2_off_its_cells_middle_on(z: float, touches: bool) -> None:
    assert overlaps((0.5, 64.0, z), 1.8, (0, 64, 1)) is touches


def test_two_keys_together_give_an_input_of_length_1() -> None:
    east, south = wish(1, 1, "walk", 0.0)
    assert math.hypot(east, south) == pytest.approx(1.0)
    assert wish(1, 0, "walk", 0.0) == pytest.approx((0.0, 0.98))
    assert wish(0, 1, "sneak", 0.0) == pytest.approx((0.294, 0.0))


def test_on_ice_a_step_is_shorter_and_its_coasting_longer() -> None:
    ice = Ground(slipperiness=0.98)
    assert ice.inertia == pytest.approx(0.8918)
    assert INPUT * ice.acceleration == pytest.approx(0.02249, abs=1e-5)
    assert displacement(5, "walk", ice) == pytest.approx(1.0126, abs=1e-3)


@given(ticks, st.sampled_from([0.6, 0.8, 0.98]), st.floats(0.5, 2.0))
def test_steps_on_any_ground_add_up_to_its_displacement(held: int, slipperiness: float, speed: float) -> None:
    ground = Ground(slipperiness, speed)
    feet, velocity, stands = (0.5, 64.0, 0.5), AT_REST, True
    for tick in range(held + 100):
        push = wish(tick < held, 0, "walk", 0.0)
        feet, velocity, stands = step(feet, velocity, push, 1.8, is_floor, on_ground=stands, ground=ground)
    assert feet[2] - 0.5 == pytest.approx(displacement(held, "walk", ground), abs=1e-9)


@given(st.integers(-1, 1), st.integers(-1, 1), st.floats(-180, 180))
def test_a_sneaking_player_never_walks_over_an_edge(forward: int, left: int, yaw: float) -> None:
    def is_solid(x: int, y: int, z: int) -> bool:
        return y < 64 and abs(x) <= 1 and abs(z) <= 1

    feet, velocity, stands = (0.5, 64.0, 0.5), AT_REST, True
    for _ in range(200):
        push = wish(forward, left, "sneak", yaw)
        feet, velocity, stands = step(feet, velocity, push, 1.5, is_solid, on_ground=stands, sneaks=True)
    assert feet[1] == 64.0
    # The floor goes from -1 to 2: the box of a player, 0.3 to each side, may stand out over its edge, not beyond it.
    assert min(feet[0], feet[2]) > -1.3
    assert max(feet[0], feet[2]) < 2.3


def test_a_walking_player_walks_over_an_edge() -> None:
    def is_solid(_x: int, y: int, z: int) -> bool:
        return y < 64 and z <= 1

    feet, velocity, stands = (0.5, 64.0, 0.5), AT_REST, True
    for _ in range(40):
        push = wish(1, 0, "walk", 0.0)
        feet, velocity, stands = step(feet, velocity, push, 1.8, is_solid, on_ground=stands)
    assert feet[1] < 60


def gaits_of(keys: Sequence[str], version: str = "1.20.1", may_sprint: bool = True) -> list[Gait]:
    """Return the gaits of ticks in which these keys are down: any of w and s (for sneak)."""
    gaits = Gaits(Edition(version))
    return [gaits.tick(is_forward="w" in down, sneaks="s" in down, may_sprint=may_sprint) for down in keys]


def twice(apart: int) -> list[str]:
    """Hold forward in tick 0, and in two ticks from ``apart`` on."""
    return ["w", *[""] * (apart - 1), "w", "w"]


@pytest.mark.parametrize("apart", range(2, SPRINT_WINDOW))
def test_a_second_press_within_the_sprint_window_sprints_until_it_is_released(apart: int) -> None:
    assert gaits_of([*twice(apart), "", "w"])[apart:] == [
        "sprint",
        "sprint",
        "walk",
        "walk" if apart >= 4 else "sprint",
    ]


def test_a_second_press_after_the_sprint_window_walks() -> None:
    assert set(gaits_of(twice(SPRINT_WINDOW))) == {"walk"}


def test_one_long_press_of_forward_never_sprints() -> None:
    assert set(gaits_of(["w"] * 20)) == {"walk"}


def test_a_player_who_may_not_sprint_walks() -> None:
    assert set(gaits_of(twice(3), may_sprint=False)) == {"walk"}


def test_a_tick_of_sneaking_between_two_presses_prevents_sprinting() -> None:
    assert gaits_of(["w", "s", "", "w"]) == ["walk", "walk", "sneak", "walk"]


def test_from_1_15_on_sneaking_slows_down_a_tick_after_its_key() -> None:
    keys = ["ws", "ws", "ws", "w"]
    assert gaits_of(keys, "1.15") == ["walk", "sneak", "sneak", "sneak"]
    assert gaits_of(keys, "1.14.4") == ["sneak", "sneak", "sneak", "walk"]


HEIGHT = 1.8


def two(first: Vector, second: Vector) -> tuple[VirtualGame, VirtualGame]:
    one = Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player(first))
    other = Realm(Edition("1.20.1"), one.world, Player(second), "Player2", players=one.players)
    return VirtualGame(one), VirtualGame(other)


@pytest.mark.parametrize(
    ("other", "is_touched"),
    [((0.59, 64.0, 0.0), True), ((0.61, 64.0, 0.0), False), ((0.5, 64.0, 0.59), True), ((0.0, 65.9, 0.0), False)],
)
def test_players_are_0_6_wide_and_1_8_high(other: Vector, is_touched: bool) -> None:
    assert touches((0.0, 64.0, 0.0), other, HEIGHT) == is_touched


def test_a_step_into_another_player_is_kept_only_along_the_free_axis() -> None:
    before, after = (0.0, 64.0, 0.0), (0.5, 64.0, 0.1)
    assert kept_apart(before, after, [(1.0, 64.0, 0.0)], HEIGHT) == (0.0, 64.0, 0.1)
    assert kept_apart(before, after, [(5.0, 64.0, 0.0)], HEIGHT) == after


def test_a_player_who_overlaps_another_can_move_out() -> None:
    assert kept_apart((0.0, 64.0, 0.0), (0.1, 64.0, 0.0), [(0.2, 64.0, 0.0)], HEIGHT) == (0.1, 64.0, 0.0)


def test_a_player_is_stopped_by_another_player() -> None:
    walker, _ = two((0.5, 64.0, 0.5), (0.5, 64.0, 3.5))
    walker.keys.press("w")
    for _ in range(60):
        walker.tick()
    assert 2.6 < walker.realm.player.feet[2] <= 2.9
    walker.keys.release("w")
    walker.keys.press("d")
    for _ in range(60):
        walker.tick()
    assert walker.realm.player.feet[0] < -3, "beside it the way is free"


def test_no_block_is_placed_into_another_player() -> None:
    builder, other = two((0.5, 64.0, 0.5), (0.5, 64.0, 1.5))
    builder.realm.player.hotbar[0] = Stack("stone", 64)
    builder.realm.player.look(0.0, 65.0)
    builder.keys.press("right button")
    builder.tick()
    assert builder.realm.world.built() == {}
    builder.keys.release("right button")
    other.realm.player.go_to((4.5, 64.0, 4.5))
    for _ in range(5):
        builder.tick()
    builder.keys.press("right button")
    builder.tick()
    assert other.realm.world.built() == {(0, 64, 1): "stone"}, "the other sees it, it is the same world"


def test_a_single_player_has_no_others_in_the_world() -> None:
    realm = Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5)))
    assert realm.others() == []
