"""What is drawn with text, chat, hotbar and crosshair has to come out as the bare world does."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame
from mc_nested.live.model.scales import Scales
from mc_nested.live.vision.world_greys import SIDE, hidden_regions, world_greys
from sim.client.client import VirtualClient
from sim.client.drawing.scenery import SEEN
from sim.client.game.realm import Stack
from tests.sim.client.playing import command

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
    """The window with nothing over the world."""
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
    """Which dots have any part of what may be hidden."""
    mask = np.zeros((size[1], size[0]), np.float32)
    for region in hidden_regions(size, scale):
        mask[region.top : region.top + region.height, region.left : region.left + region.width] = 1
    return np.asarray(cv2.resize(mask, (SIDE, SIDE), interpolation=cv2.INTER_AREA)) > 0


@pytest.mark.parametrize("version", ["1.12.2", "1.14.4", "1.18.2", "1.20.1", "26.1", "26.4"])
@pytest.mark.parametrize("scale", [1, 2])
def test_the_world_comes_out_as_if_nothing_lay_over_it(version: str, scale: int) -> None:
    client = client_looking(scale=scale, version=version)
    found = world_greys(client.display.grab(), client.scales).astype(int)
    elsewhere = ~hidden(client.display.size(), scale)
    away = np.abs(found - plainly(bare(client)))[elsewhere]
    assert away.max() <= NEAR
    assert np.mean(away > 2) < 0.01


@given(st.floats(40, 85), st.floats(-180, 180))
def test_that_holds_wherever_the_agent_looks(pitch: float, yaw: float) -> None:
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


def test_chat_hotbar_and_crosshair_make_no_difference() -> None:
    client = client_looking()
    before = world_greys(client.display.grab(), Scales(1, 1))
    client.realm.player.hotbar[5:] = [Stack("sand", 64)] * 4
    command(client, "/time set 1")
    client.clock.sleep(0.3)
    with_chat = client.display.grab()
    assert (with_chat != client_looking().display.grab()).any()
    assert np.array_equal(world_greys(with_chat, Scales(1, 1))[hidden((854, 480), 1)], before[hidden((854, 480), 1)])
    assert np.abs(world_greys(with_chat, Scales(1, 1)).astype(int) - before).max() <= NEAR


def test_the_text_of_another_place_makes_no_difference() -> None:
    pictures = []
    for x in (0.5, 12345.5):
        client = VirtualClient(world=SEEN, pitch=65.0, scale=1, feet=(x, 64.0, 0.5))
        client.clock.sleep(0.2)
        pictures.append(world_greys(client.display.grab(), Scales(1, 1)).astype(int))
    assert np.abs(pictures[0] - pictures[1]).max() <= NEAR


def test_where_the_chat_may_be_it_is_black() -> None:
    greys = world_greys(np.full((480, 854, 3), 200, np.uint8), Scales(1, 1))
    # From 138 to 38 GUI pixels over the lower edge, 332 wide: rows 60 to 77 of 84, columns 0 to 32.
    assert not greys[61:76, :32].any()
    assert (greys[61:73, 34:] == 200).all()
    # Nor is the hotbar seen, 242 wide in the middle of the lowest 60.
    assert not greys[75:, 31:53].any()
    assert (greys[75:, 55:] == 200).all()
