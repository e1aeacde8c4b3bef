"""Arenas as their windows show them, on virtual clients.

What is drawn with text, chat, hotbar and crosshair has to come out as the bare world does.
"""

from collections.abc import Iterator

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv
from mc_nested.errors import LiveError, UserError
from mc_nested.live.devices import Frame
from mc_nested.live.screen_arenas import FRAMES, NEEDS_A_WINDOW, SIDE, ScreenArenas, hidden_regions, world_greys
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing.painter import SEEN
from sim.client.game.realm import Stack
from sim.grid import GridGame
from sim.virtual_games import open_virtual_games
from tests.sim.client.playing import command

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


def test_a_step_appends_its_picture_to_the_last_three(arenas: ScreenArenas) -> None:
    before, _ = arenas.reset()
    after, rewards, terminated, _, info = arenas.step(np.array([FD, F]))
    assert np.array_equal(after[:, :-1], before[:, 1:])
    assert not np.array_equal(after[:, -1], before[:, -1])
    assert rewards.tolist() == [1.0, 0.0]
    assert not terminated.any()
    assert not info["_score"].any()
    # A block stands right ahead in the first arena alone.
    assert np.abs(after[0, -1].astype(int) - after[1, -1]).max() > 20


def test_returned_observations_never_change_afterwards(arenas: ScreenArenas) -> None:
    first, _ = arenas.reset()
    kept = first.copy()
    arenas.step(np.array([F, F]))
    assert np.array_equal(first, kept)


def test_arenas_that_have_ended_or_get_no_action_keep_their_pictures(arenas: ScreenArenas) -> None:
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


def test_screen_arenas_know_the_agents_cell_and_the_blocks_and_cant_be_resumed(arenas: ScreenArenas) -> None:
    arenas.reset()
    arenas.step(np.array([FD, F]))
    assert arenas.cell(0) == arenas.cell(1) == (2, 1)
    assert arenas.placed(0) == frozenset({(2, 2)})
    assert arenas.placed(1) == frozenset()
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


def test_a_reset_without_known_scales_asks_for_f3() -> None:
    with open_virtual_games([SMALL]) as games:
        arenas = ScreenArenas(ArenaVectorEnv([ArenaEnv(games[0], SMALL)]))
        arenas.reset()
        screen = games[0].connection.screen
        screen.seen_scales = lambda: None  # type: ignore[method-assign]  # as in a window of another size, F3 off
        with pytest.raises(LiveError, match="press F3 in the game"):
            arenas.reset()


NEAR = 12
"""Levels by which a dot may differ whose window pixels are mostly letters."""


def client_looking(pitch: float = 65.0, yaw: float = 0.0, scale: int = 1, version: str = "1.20.1") -> VirtualClient:
    # From 1.21.9 on the columns need more room beside each other.
    size = (1280, 720) if version.startswith("26.") else (854, 480)
    client = VirtualClient(world=SEEN, pitch=pitch, yaw=yaw, scale=scale, version=version, size=size)
    world = client.realm.world
    for block, name in (((0, 64, 2), "stone"), ((-1, 64, 2), "sand"), ((2, 64, 1), "dirt"), ((-2, 63, 0), "obsidian")):
        world.put(block, name)
    client.clock.sleep(0.2)
    return client


def bare(client: VirtualClient) -> Frame:
    """Return the window with nothing over the world."""
    client.game.hides_hud = True
    client.clock.sleep(0.2)
    frame = client.display.grab()
    client.game.hides_hud = False
    client.clock.sleep(0.2)
    return frame


def plainly(frame: Frame) -> np.ndarray:
    greys = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY)
    return np.asarray(cv2.resize(greys, (SIDE, SIDE), interpolation=cv2.INTER_AREA)).astype(int)


def hidden(size: tuple[int, int], scale: int) -> np.ndarray:
    """Return which dots have any part of what may be hidden."""
    mask = np.zeros((size[1], size[0]), np.float32)
    for region in hidden_regions(size, scale):
        mask[region.top : region.top + region.height, region.left : region.left + region.width] = 1
    return np.asarray(cv2.resize(mask, (SIDE, SIDE), interpolation=cv2.INTER_AREA)) > 0


@pytest.mark.parametrize("version", ["1.12.2", "1.14.4", "1.18.2", "1.20.1", "26.1", "26.4"])
@pytest.mark.parametrize("scale", [1, 2])
def test_the_greys_show_the_world_as_if_nothing_lay_over_it(version: str, scale: int) -> None:
    client = client_looking(scale=scale, version=version)
    found = world_greys(client.display.grab(), client.scales).astype(int)
    elsewhere = ~hidden(client.display.size(), scale)
    away = np.abs(found - plainly(bare(client)))[elsewhere]
    assert away.max() <= NEAR
    assert np.mean(away > 2) < 0.01


@given(st.floats(40, 85), st.floats(-180, 180))
def test_the_greys_show_the_bare_world_whichever_way_the_agent_looks(pitch: float, yaw: float) -> None:
    client = client_looking(pitch, yaw)
    away = np.abs(world_greys(client.display.grab(), Scales(1, 1)).astype(int) - plainly(bare(client)))
    # The sky is as bright as letters are, so a horizon at a text's edge may cost a dot.
    assert np.mean(away[~hidden(client.display.size(), 1)] > NEAR) < 0.002


def test_a_picture_is_84_rows_of_84_greys_whatever_the_windows_size() -> None:
    for size in ((854, 480), (1280, 720), (640, 360)):
        greys = world_greys(np.full((size[1], size[0], 3), 77, np.uint8), Scales(1, 1))
        assert greys.shape == (84, 84)
        assert greys.dtype == np.uint8
        assert set(np.unique(greys)) <= {0, 77}


def test_the_greys_do_not_depend_on_the_chat_or_the_hotbars_contents() -> None:
    client = client_looking()
    before = world_greys(client.display.grab(), Scales(1, 1))
    client.realm.player.hotbar[5:] = [Stack("sand", 64)] * 4
    command(client, "/time set 1")
    client.clock.sleep(0.3)
    with_chat = client.display.grab()
    assert (with_chat != client_looking().display.grab()).any()
    assert np.array_equal(world_greys(with_chat, Scales(1, 1))[hidden((854, 480), 1)], before[hidden((854, 480), 1)])
    assert np.abs(world_greys(with_chat, Scales(1, 1)).astype(int) - before).max() <= NEAR


def test_the_greys_do_not_depend_on_the_debug_screens_text() -> None:
    pictures = []
    for x in (0.5, 12345.5):
        client = VirtualClient(world=SEEN, pitch=65.0, scale=1, feet=(x, 64.0, 0.5))
        client.clock.sleep(0.2)
        pictures.append(world_greys(client.display.grab(), Scales(1, 1)).astype(int))
    assert np.abs(pictures[0] - pictures[1]).max() <= NEAR


def test_the_chats_and_hotbars_regions_are_black_in_the_greys() -> None:
    greys = world_greys(np.full((480, 854, 3), 200, np.uint8), Scales(1, 1))
    # From 138 to 38 GUI pixels over the lower edge, 332 wide: rows 60 to 77 of 84, columns 0 to 32.
    assert not greys[61:76, :32].any()
    assert (greys[61:73, 34:] == 200).all()
    # Nor is the hotbar seen, 242 wide in the middle of the lowest 60.
    assert not greys[75:, 31:53].any()
    assert (greys[75:, 55:] == 200).all()
