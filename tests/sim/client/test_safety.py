"""Safety on the virtual client: whatever happens and however it ends, no key stays down and none goes elsewhere."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, StoppedError
from mc_nested.live.input.stops import CORNER_REASON, KEY_REASON, corners_of
from sim.client.client import VirtualClient
from sim.client.mishaps import KINDS, Kind
from tests.sim.client.playing import arena_of, play

LINE = load_scenario("line")
mishaps = st.lists(st.tuples(st.sampled_from(KINDS), st.floats(0.0, 6.0)), max_size=5)
actions = st.lists(st.sampled_from(list(Action)), max_size=8)


class WayOutError(Exception):
    """Something else in the program fails."""


@pytest.mark.slow
@given(
    mishaps, actions, st.sampled_from(["return", "error", "interrupt", "stop"]), st.floats(0.0, 5.0), st.integers(0, 99)
)
def test_no_key_is_left_down_or_sent_to_another_window_however_the_game_ends(
    planned: list[tuple[Kind, float]], chosen: list[Action], way_out: str, out_s: float, seed: int
) -> None:
    client = VirtualClient(seed=seed)
    out_at = client.clock.now() + out_s

    def leave() -> None:
        if way_out == "error":
            raise WayOutError
        if way_out == "interrupt":
            raise KeyboardInterrupt

    with contextlib.suppress(LiveError, WayOutError, KeyboardInterrupt), play(client, LINE) as game:
        client.clock.call_at(out_at, leave)
        if way_out == "stop":
            client.clock.call_at(out_at, lambda: game.connection.controller.stop(KEY_REASON))
        for kind, in_s in planned:
            client.mishaps.plan(kind, in_s)
        game.reset(LINE.best_material)
        for action in chosen:
            game.act(action)
    assert client.window.down == set()
    assert client.window.strays == []


@pytest.mark.slow
@given(mishaps, actions, st.integers(0, 99))
def test_every_outcome_agrees_with_the_world_despite_mishaps(
    planned: list[tuple[Kind, float]], chosen: list[Action], seed: int
) -> None:
    client = VirtualClient(seed=seed)
    arena = arena_of(client)
    with contextlib.suppress(LiveError), play(client, LINE) as game:
        game.reset(LINE.best_material)
        # A block that is taken back after it was seen is noticed by a later look, not by this one.
        for kind, in_s in planned:
            if kind != "ghost_block":
                client.mishaps.plan(kind, in_s)
        built = set()
        for action in chosen:
            outcome = game.act(action)
            built |= {outcome.placed} if outcome.placed else set()
            assert client.cell(arena) == outcome.cell
            assert client.placed(arena) == built


@pytest.mark.parametrize("in_s", [0.01, 0.07, 0.13, 0.29])
def test_the_panic_key_stops_everything_within_a_tenth_of_a_second(in_s: float) -> None:
    client = VirtualClient(seed=1)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        stopped_at = client.clock.now() + in_s
        client.clock.call_at(stopped_at, lambda: game.connection.controller.stop(KEY_REASON))
        with pytest.raises(StoppedError, match="panic key"):
            [game.act(action) for action in (Action.BD, Action.BD)]
        assert client.clock.now() - stopped_at <= 0.1
        assert client.window.down == set()
        with pytest.raises(StoppedError):
            game.reset(LINE.best_material)
    assert "corner" in CORNER_REASON


def test_a_screen_has_four_corners() -> None:
    assert set(corners_of(1920, 1080)) == {(0, 0), (1919, 0), (0, 1079), (1919, 1079)}


@pytest.mark.parametrize("kind", KINDS)
def test_a_reset_recovers_after_every_kind_of_mishap(kind: Kind) -> None:
    client = VirtualClient(seed=4)
    arena = arena_of(client)
    with play(client, LINE) as game:
        game.reset(LINE.best_material)
        client.mishaps.plan(kind, 0.2)
        with contextlib.suppress(LiveError):
            for action in (Action.B, Action.BD, Action.BD):
                game.act(action)
        client.clock.sleep(0.5)
        assert game.reset(LINE.best_material) == LINE.start == client.cell(arena)
        assert client.placed(arena) == set()
        assert game.act(Action.BD).placed == (7, 14)
    assert client.window.down == set()
