import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.client import VirtualClient
from sim.client.game.realm import Stack
from sim.client.game.screens import ScreenName, menu
from tests.sim.client.playing import command

WHITE, SHADOW = (255, 255, 255), (63, 63, 63)


def text_in(frame: Frame, colour: tuple[int, int, int]) -> np.ndarray:
    return np.asarray((frame == colour[::-1]).all(2))


@pytest.mark.parametrize("name", ["title", "worlds", "pause", "death", "disconnected"])
@pytest.mark.parametrize(("size", "scale"), [((854, 480), 2), ((1366, 768), 3)])
def test_each_label_lies_in_the_middle_of_its_button(name: ScreenName, size: tuple[int, int], scale: int) -> None:
    client = VirtualClient(size=size, scale=scale)
    client.game.open(name)
    client.clock.sleep(1.2)
    frame = client.display.grab()
    gui = -(-size[0] // scale), -(-size[1] // scale)
    for button in menu(client.game.view().menu, client.edition, *gui).buttons:
        if not button.label:
            continue
        left, top = button.left * scale, button.top * scale
        inside = frame[top + 2 * scale : top + 18 * scale, left : left + button.width * scale]
        ink = text_in(inside, WHITE if button.is_active else (160, 160, 160))
        columns = np.flatnonzero(ink.any(0))
        assert abs((columns[0] + columns[-1] + 1) / 2 - button.width * scale / 2) <= 1.5 * scale


def test_the_chat_lies_over_the_lower_left_and_goes_after_ten_seconds() -> None:
    client = VirtualClient(world="dark")
    client.clock.sleep(0.2)
    before = client.display.grab()
    command(client, "/time set 1")
    during = client.display.grab()
    client.clock.sleep(11.0)
    after = client.display.grab()
    changed = np.flatnonzero((before != during).any((1, 2)))
    assert changed[0] >= 2 * (240 - 49)
    assert changed[-1] < 2 * (240 - 40)
    assert np.array_equal(before, after)


def test_what_is_in_the_hotbar_is_seen_with_its_count() -> None:
    client = VirtualClient(world="dark")
    client.clock.sleep(0.1)
    empty = client.display.grab()
    client.realm.player.hotbar[8] = Stack("stone", 64)
    client.clock.sleep(0.1)
    changed = np.argwhere((client.display.grab() != empty).any(2)) / 2
    assert changed[:, 0].min() >= 240 - 22
    assert 213 + 69 <= changed[:, 1].min() <= changed[:, 1].max() <= 213 + 91


def test_f1_hides_all_that_lies_over_the_world() -> None:
    client = VirtualClient(world="flat")
    client.game.hides_hud = True
    client.clock.sleep(0.2)
    assert len(np.unique(client.display.grab().reshape(-1, 3), axis=0)) == 1
