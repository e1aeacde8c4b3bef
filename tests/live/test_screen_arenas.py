"""Arenas as their windows show them, on virtual clients."""

from collections.abc import Iterator

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv
from mc_nested.errors import LiveError, UserError
from mc_nested.live.screen_arenas import FRAMES, NEEDS_A_WINDOW, ScreenArenas
from sim.grid import GridGame
from sim.virtual_games import open_virtual_games

SMALL = Scenario("small", frozenset({(2, 2), (3, 2)}), (2, 0), 5, (Material("stone", 1.0, "stone"),), 5)
F, R, FD = int(Action.F), int(Action.R), int(Action.FD)


@pytest.fixture
def arenas() -> Iterator[ScreenArenas]:
    with open_virtual_games([SMALL, SMALL], seed=3) as games:
        yield ScreenArenas(ArenaVectorEnv([ArenaEnv(game, SMALL) for game in games]))


def test_an_observation_is_four_pictures_of_greys(arenas: ScreenArenas) -> None:
    pictures, _ = arenas.reset()
    assert pictures.shape == (2, FRAMES, 84, 84)
    assert pictures.dtype == np.uint8
    assert arenas.observation_space.contains(pictures)
    assert arenas.single_observation_space.contains(pictures[0])


def test_a_reset_shows_its_one_picture_four_times(arenas: ScreenArenas) -> None:
    pictures, _ = arenas.reset()
    assert all(np.array_equal(pictures[0, 0], other) for other in pictures[0, 1:])
    assert pictures[0, 0].std() > 3, "something is seen"


def test_a_step_adds_its_picture_behind_the_last_three(arenas: ScreenArenas) -> None:
    before, _ = arenas.reset()
    after, rewards, terminated, _, info = arenas.step(np.array([FD, F]))
    assert np.array_equal(after[:, :-1], before[:, 1:])
    assert not np.array_equal(after[:, -1], before[:, -1])
    assert rewards.tolist() == [1.0, 0.0]
    assert not terminated.any()
    assert not info["_score"].any()
    # A block stands right ahead in the first arena alone.
    assert np.abs(after[0, -1].astype(int) - after[1, -1]).max() > 20


def test_what_was_returned_never_changes_afterwards(arenas: ScreenArenas) -> None:
    first, _ = arenas.reset()
    kept = first.copy()
    arenas.step(np.array([F, F]))
    assert np.array_equal(first, kept)


def test_no_action_takes_no_picture_and_an_ended_arena_waits_for_its_reset(arenas: ScreenArenas) -> None:
    arenas.reset()
    walked, *_ = arenas.step(np.array([F, NO_ACTION]))
    for _ in range(4):
        last, _, _, truncated, info = arenas.step(np.array([R, NO_ACTION]))
    assert truncated.tolist() == [True, False]
    assert info["score"][0] == 1.0
    assert np.array_equal(last[1], walked[1])
    waiting, *_ = arenas.step(np.array([F, NO_ACTION]))
    assert np.array_equal(waiting, last)
    begun, _ = arenas.reset(options={"reset_mask": np.array([True, False])})
    assert np.array_equal(begun[0, 0], begun[0, 3])
    assert np.array_equal(begun[1], last[1])
    gone_on, *_ = arenas.step(np.array([F, F]))
    assert not np.array_equal(gone_on[0], begun[0])


def test_they_say_where_the_agent_is_and_what_is_built_and_cant_be_resumed(arenas: ScreenArenas) -> None:
    arenas.reset()
    arenas.step(np.array([FD, F]))
    assert arenas.cell(0) == arenas.cell(1) == (2, 1)
    assert arenas.placed(0) == frozenset({(2, 2)})
    assert arenas.placed(1) == frozenset()
    assert arenas.scenario is SMALL
    assert arenas.resumable is None


def test_the_same_seed_shows_the_same_pictures() -> None:
    seen = []
    for _ in range(2):
        with open_virtual_games([SMALL], seed=9) as games:
            arenas = ScreenArenas(ArenaVectorEnv([ArenaEnv(games[0], SMALL)]))
            seen.append([arenas.reset()[0], arenas.step(np.array([FD]))[0], arenas.step(np.array([R]))[0]])
    assert all(np.array_equal(one, other) for one, other in zip(*seen, strict=True))


def test_a_simulated_game_has_no_window() -> None:
    with pytest.raises(UserError, match="train with --backend virtual, or --backend live") as caught:
        ScreenArenas(ArenaVectorEnv([ArenaEnv(GridGame(SMALL), SMALL)]))
    assert str(caught.value) == NEEDS_A_WINDOW


def test_without_the_debug_screen_the_scale_isnt_known() -> None:
    with open_virtual_games([SMALL]) as games:
        arenas = ScreenArenas(ArenaVectorEnv([ArenaEnv(games[0], SMALL)]))
        arenas.reset()
        screen = games[0].connection.screen
        screen.seen_scales = lambda: None  # type: ignore[method-assign]  # as in a window of another size, F3 off
        with pytest.raises(LiveError, match="press F3 in the game"):
            arenas.reset()
