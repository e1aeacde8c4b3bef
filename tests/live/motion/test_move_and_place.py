"""Body: one cell and one block, each confirmed by what the screen says, or an error that says what was seen."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.errors import NotConfirmedError, NotInFrontError, UnreadableError
from mc_nested.live.action_log import Effort
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.motion.move_and_place import Body
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile, WalkTable
from tests.live.fake_game import FLOOR, FakeGame, FakeScreen, connection_to

SOUTH = Profile(arena=Arena.around((14, 64, 0), "south"))
FRONT = (7, 64, 8)
"""The block in front of cell (7, 7) in the arena above, whose cell (0, 0) is its north-east corner."""
offsets = st.floats(-0.149, 0.149)


def _game(cell: Cell = (7, 7), profile: Profile = SOUTH, off: tuple[float, float] = (0.0, 0.0)) -> FakeGame:
    arena = profile.marked_arena()
    x, y, z = arena.centre_of(cell)
    game = FakeGame(profile, xyz=(x + off[0], y, z + off[1]), yaw=arena.yaw, pitch=profile.body.pitch)
    game.hotbar[0] = "stone"
    return game


def _body(game: FakeGame) -> Body:
    return Body(game.profile, connection_to(game))


def _off(game: FakeGame, cell: Cell) -> float:
    """Return how far off a cell's middle the agent is once it has stopped."""
    game.clock.sleep_until(game.clock.now() + 1.0)
    game.read()
    place = game.profile.marked_arena().position_of(game.xyz)
    return max(abs(place[0] - cell[0]), abs(place[1] - cell[1]))


@given(
    st.sampled_from(["north", "south", "west", "east"]),
    st.sampled_from([(7, 8), (7, 6), (6, 7), (8, 7)]),
    offsets,
    offsets,
)
def test_a_move_ends_within_the_tolerance_of_the_next_cell(
    facing: Facing, cell: Cell, east: float, south: float
) -> None:
    game = _game(profile=Profile(arena=Arena.around((-40, 64, 9), facing)), off=(east, south))
    assert _body(game).move_to(cell).cell == cell
    assert _off(game, cell) <= 0.15
    assert game.down == set()


@given(st.floats(0.0, 0.049), st.floats(0.0, 0.03))
def test_one_press_is_enough_for_one_cell_from_the_middle(phase: float, latency: float) -> None:
    game = _game()
    game.phase, game.latency = phase, latency
    _body(game).move_to((7, 6))
    assert len(game.presses) <= 2


def test_a_move_to_where_the_agent_is_presses_nothing() -> None:
    game = _game(off=(0.1, -0.14))
    assert _body(game).move_to((7, 7)).cell == (7, 7)
    assert game.presses == []


def test_a_move_presses_the_key_that_the_profile_names() -> None:
    keys = SOUTH.keys.model_copy(update={"left": "d", "right": "a"})
    game = _game(profile=SOUTH.model_copy(update={"keys": keys}))
    _body(game).move_to((6, 7))
    assert game.presses == ["d"]


def test_a_move_ends_well_despite_a_wrong_walk_response() -> None:
    fast = WalkTable(covered=tuple(0.5 * ticks for ticks in range(1, 13)))
    game = _game(profile=SOUTH.model_copy(update={"walk": fast}))
    _body(game).move_to((7, 8))
    assert _off(game, (7, 8)) <= 0.15
    assert len(game.presses) > 1


def test_an_agent_moved_far_away_is_not_walked_back() -> None:
    game = _game((3, 3))
    with pytest.raises(NotConfirmedError, match=r"cell \(7, 8\) is no neighbour .* at \(3.00, 3.00\)"):
        _body(game).move_to((7, 8))
    assert game.presses == []


def test_a_move_into_an_unknown_block_is_not_confirmed() -> None:
    game = _game()
    game.blocks[FRONT] = "stone"
    with pytest.raises(NotConfirmedError, match=r"cell \(7, 8\) was not reached in 8 tries, .* in the way"):
        _body(game).move_to((7, 8))
    assert len(game.presses) == 8


@given(offsets, offsets, st.sampled_from(["north", "south", "west", "east"]))
def test_a_block_lands_in_front_from_anywhere_within_the_tolerance(east: float, south: float, facing: Facing) -> None:
    game = _game(profile=Profile(arena=Arena.around((3, 64, 3), facing)), off=(east, south))
    assert _body(game).place((7, 7), "minecraft:stone") == (7, 8)
    assert game.built == {game.profile.marked_arena().block_of((7, 8))}
    assert game.presses == ["right button"]


@given(st.sampled_from([(7, 8), (7, 6), (6, 7), (8, 7)]), offsets, offsets, st.floats(0.05, 0.4), st.floats(0, 0.6))
def test_building_with_late_events_is_right_or_an_error(
    cell: Cell, right: float, forward: float, since: float, late: float
) -> None:
    game = _game(off=(-right, forward))
    front = SOUTH.marked_arena().block_of((cell[0], cell[1] + 1))
    body = _body(game)
    body.arrive((7, 7))
    game.late_from, game.late_until = game.clock.now() + since, game.clock.now() + since + late
    try:
        body.build(cell, {}, "minecraft:stone")
    except NotConfirmedError:
        return
    game.clock.sleep_until(game.clock.now() + 1.0)
    game.read()
    assert game.built == {front}
    assert _off(game, cell) < 0.5


@pytest.mark.parametrize("refused", [0, 1])
def test_an_agent_carried_on_within_its_cell_during_a_click_walks_back(refused: int) -> None:
    game = _game(off=(0.077, 0.135))
    game.refuse_clicks = refused
    body = _body(game)
    body.arrive((7, 7))
    game.late_from, game.late_until = game.clock.now() + 0.173, game.clock.now() + 0.346
    assert body.build((7, 6), {}, "minecraft:stone") == (7, 7)
    assert game.built == {SOUTH.marked_arena().block_of((7, 7))}
    assert game.presses == ["s", "right button", "w", *["right button"] * refused]
    assert body.effort == Effort(moves=1, corrections=1, clicks=1 + refused)
    assert _off(game, (7, 6)) <= 0.15


def test_an_agent_carried_past_its_cell_during_a_click_is_an_error() -> None:
    game = _game()
    body = _body(game)
    body.arrive((7, 7))
    game.late_from, game.late_until = game.clock.now() + 0.141, game.clock.now() + 0.5
    with pytest.raises(NotConfirmedError, match=r"carried on while it clicked, past cell \(8, 7\), to"):
        body.build((8, 7), {}, "minecraft:stone")


@pytest.mark.parametrize("cell", [(6, 7), (8, 7)])
def test_a_block_beside_the_path_is_clicked_before_the_agents_stop_is_certain(cell: Cell) -> None:
    on_the_way, one_by_one = _game(), _game()
    _body(on_the_way).build(cell, {}, "minecraft:stone")
    body = _body(one_by_one)
    body.place(cell, "minecraft:stone", body.move_to(cell))
    assert on_the_way.clock.now() < one_by_one.clock.now() - 0.04
    assert on_the_way.built == one_by_one.built
    assert on_the_way.presses == one_by_one.presses


def test_a_second_hold_on_the_way_to_a_block_is_counted_as_a_correction() -> None:
    game = _game()
    body = _body(game)
    body.arrive((7, 7))
    game.late_from, game.late_until = game.clock.now() + 0.1, game.clock.now() + 0.45
    body.build((7, 8), {}, "minecraft:stone")
    assert (body.effort.moves, body.effort.clicks) == (1, 1)
    assert body.effort.corrections == len([press for press in game.presses if press in "wasd"]) - 1 > 0


def test_no_click_at_the_arenas_edge_is_sent_before_the_stop_is_certain() -> None:
    on_the_way, one_by_one = _game((1, 7)), _game((1, 7))
    _body(on_the_way).build((0, 7), {}, "minecraft:stone")
    body = _body(one_by_one)
    body.place((0, 7), "minecraft:stone", body.move_to((0, 7)))
    assert on_the_way.clock.now() == one_by_one.clock.now()


@pytest.mark.parametrize(("size", "is_known"), [(15, False), (16, True)])
def test_the_floor_ahead_is_checked_only_inside_the_arenas_own_size(size: int, is_known: bool) -> None:
    profile = Profile(arena=Arena.around((14, 64, 0), "south", size=size))
    game = _game((7, 14), profile)
    game.blocks[profile.marked_arena().block_of((7, 15))] = "stone"
    body = _body(game)
    if not is_known:
        body.check_floor_ahead()
        return
    with pytest.raises(NotConfirmedError, match="only the floor should be at"):
        body.check_floor_ahead()


def test_a_click_that_the_game_missed_is_repeated() -> None:
    game = _game()
    game.refuse_clicks = 2
    _body(game).place((7, 7), "minecraft:stone")
    assert (game.built, len(game.presses)) == ({FRONT}, 3)


def test_place_gives_up_after_eight_clicks() -> None:
    game = _game()
    game.hotbar.clear()
    with pytest.raises(NotConfirmedError, match=r"no minecraft:stone was seen at \(7, 64, 8\) after 8 clicks"):
        _body(game).place((7, 7), "minecraft:stone")
    assert len(game.presses) == 8


def test_an_occupied_cell_is_never_clicked() -> None:
    game = _game()
    game.blocks[FRONT] = "stone"
    with pytest.raises(NotConfirmedError, match=r"says minecraft:stone at \(7, 64, 8\): is the cell free"):
        _body(game).place((7, 7), "minecraft:stone")
    assert game.presses == []


def test_a_block_of_another_material_is_not_taken_for_the_right_one() -> None:
    game = _game()
    with pytest.raises(NotConfirmedError, match=r"minecraft:stone at .* was placed, not minecraft:oak_planks"):
        _body(game).place((7, 7), "minecraft:oak_planks")
    assert len(game.presses) == 1


def test_nothing_is_clicked_while_the_screen_names_no_target_block() -> None:
    game = _game()
    body = Body(SOUTH, connection_to(game, FakeScreen(game, lambda: Reading((7.5, 64.0, 7.5), 0.0, 65.0))))
    with pytest.raises(NotConfirmedError, match=r"says that no block is looked at: .* on the debug screen"):
        body.place((7, 7), "minecraft:stone")
    assert game.presses == []


@pytest.mark.parametrize("off", [(0.0, 0.16), (0.0, -1.0), (0.9, 0.0)])
def test_an_agent_off_its_cells_middle_walks_back_before_it_clicks(off: tuple[float, float]) -> None:
    game = _game(off=off)
    assert _body(game).place((7, 7), "minecraft:stone") == (7, 8)
    assert game.presses[-1] == "right button"
    assert game.presses.count("right button") == 1
    assert len(game.presses) > 1
    assert _off(game, (7, 7)) <= 0.15


@given(st.floats(-0.99, -0.16), st.floats(0.0, 0.049))
@example(off=-0.9, phase=0.0)
def test_place_waits_until_the_agent_that_walked_back_looks_at_the_floor(off: float, phase: float) -> None:
    game = _game(off=(0.0, off))
    game.phase = phase
    assert _body(game).place((7, 7), "minecraft:stone") == (7, 8)
    assert game.built == {FRONT}


def test_an_agent_passing_the_middle_does_not_click_yet() -> None:
    game = _game()
    passing = iter([Reading((7.5, 64.0, z), 0.0, 65.0, Target((7, 63, 8), FLOOR)) for z in (7.3, 7.5, 7.7)])
    body = Body(SOUTH, connection_to(game, FakeScreen(game, lambda: next(passing, None))))
    seen = body.place((7, 7), "minecraft:stone")
    assert seen == (7, 8)
    assert next(passing, None) is None, "it was waited for the agent to stand"


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"yaw": 12.0}, "view is 12 / 65, not 0 / 65"),
        ({"pitch": 20.0}, "view is 0 / 20, not 0 / 65"),
        ({"xyz": (7.5, 65.0, 7.5)}, "feet are at y = 65, not 64"),
    ],
)
def test_a_turned_view_or_another_height_stops_moves_and_clicks(change: dict[str, object], complaint: str) -> None:
    game = _game()
    for name, value in change.items():
        setattr(game, name, value)
    body = _body(game)
    with pytest.raises(NotConfirmedError, match=complaint):
        body.move_to((7, 8))
    with pytest.raises(NotConfirmedError, match=complaint):
        body.place((7, 7), "minecraft:stone")
    with pytest.raises(NotConfirmedError, match=complaint):
        body.stay_in((7, 7))
    assert game.presses == []


def test_an_unreadable_screen_is_an_error_with_its_reason_after_5_s() -> None:
    game = _game()
    game.unreadable = True
    start = game.clock.now()
    with pytest.raises(UnreadableError, match="unreadable for 5 s: no line starts with XYZ:"):
        _body(game).move_to((7, 8))
    assert game.clock.now() - start == pytest.approx(5.0, abs=0.1)


def test_a_move_waits_while_the_screen_is_briefly_unreadable() -> None:
    game = _game()
    readings = iter([Reading(problem="chat covers it")] * 20)
    body = Body(SOUTH, connection_to(game, FakeScreen(game, lambda: next(readings, None))))
    assert body.move_to((7, 8)).cell == (7, 8)


def test_a_move_fails_if_the_player_is_pushed_on_and_on() -> None:
    game = _game()
    floor = Target((7, 63, 8), "minecraft:" + FLOOR)
    drift = FakeScreen(game, lambda: Reading((7.5, 64.0, game.clock.now() % 15), 0.0, 65.0, floor))
    body = Body(SOUTH, connection_to(game, drift))
    with pytest.raises(NotConfirmedError, match="does not stand still"):
        body.move_to((7, 8))


def test_arrive_waits_for_the_agent_and_names_the_cell_if_it_does_not_come() -> None:
    game = _game()
    arrival = game.clock.now() + 2.0
    late = FakeScreen(game, lambda: None if game.clock.now() > arrival else Reading((0, 9, 0), 1, 1))
    body = Body(SOUTH, connection_to(game, late))
    body.arrive((7, 7))
    assert game.clock.now() == pytest.approx(arrival, abs=0.05)
    with pytest.raises(
        NotConfirmedError, match=r"teleport to cell \(7, 14\) was not seen, the agent is at \(7.00, 7.00\)"
    ):
        body.arrive((7, 14))


def test_a_move_stops_when_another_window_comes_to_the_front() -> None:
    game = _game()
    game.front_until = game.clock.now() + 0.1
    with pytest.raises(NotInFrontError):
        _body(game).move_to((7, 8))
    assert game.down == set()


def test_place_does_not_click_from_a_given_pose_that_looks_at_a_block() -> None:
    game = _game()
    body = _body(game)
    game.blocks[FRONT] = "stone"
    with pytest.raises(NotConfirmedError, match=r"is the cell free"):
        body.place((7, 7), "minecraft:stone", body.move_to((7, 7)))
    assert game.presses == []


def test_a_move_to_a_cell_two_blocks_away_is_refused() -> None:
    game = _game()
    with pytest.raises(NotConfirmedError, match="is no neighbour of the agent's"):
        _body(game).move_to((7, 9))
    assert game.presses == []
