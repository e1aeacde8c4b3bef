import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from sim.client.client import VirtualClient
from sim.client.layers import Blend, Rect, draw_all
from sim.client.letters import Letters
from sim.client.picture import Picture
from sim.client.realm import Stack
from sim.client.screens import ScreenName, menu
from tests.sim.client.playing import FONT, command

WHITE, SHADOW = (255, 255, 255), (63, 63, 63)


class Note:
    """A layer that only notes which parts of it are drawn."""

    def __init__(self, rect: Rect) -> None:
        self.rect = rect
        self.parts: list[Rect] = []

    def draw(self, frame: Frame, part: Rect) -> None:
        frame[part[1] : part[3], part[0] : part[2]] += 1
        self.parts.append(part)


def text_in(frame: Frame, colour: tuple[int, int, int]) -> np.ndarray:
    return np.asarray((frame == colour[::-1]).all(2))


def test_nothing_is_drawn_before_a_grab_and_only_what_is_grabbed() -> None:
    picture, upper, lower = Picture(np.zeros((100, 50, 3), np.uint8)), Note((10, 10, 20, 20)), Note((10, 60, 20, 70))
    picture.show(np.zeros((100, 50, 3), np.uint8), [upper, lower])
    assert upper.parts == []
    part = picture.grab(Region(0, 15, 50, 10))
    assert upper.parts == [(10, 15, 20, 20)]
    assert lower.parts == []
    assert part.sum() == 5 * 10 * 3
    whole = picture.grab()
    assert whole.sum() == 2 * 10 * 10 * 3
    assert upper.parts == [(10, 15, 20, 20), (10, 10, 20, 15)]


def test_only_what_changed_is_drawn_again() -> None:
    world = np.zeros((100, 50, 3), np.uint8)
    picture, kept, gone, new = Picture(world), Note((0, 0, 9, 9)), Note((0, 20, 9, 29)), Note((0, 40, 9, 49))
    picture.show(world, [kept, gone])
    before = picture.grab()
    picture.show(world, [kept, new])
    after = picture.grab()
    assert len(kept.parts) == len(gone.parts) == len(new.parts) == 1
    assert before[20:29].any()
    assert not after[20:29].any()
    assert after[40:49, :9].all()


def test_a_picture_once_given_never_changes() -> None:
    world = np.zeros((10, 10, 3), np.uint8)
    picture = Picture(world)
    first = picture.grab()
    picture.show(world, [Blend((0, 0, 10, 10), WHITE, 255)])
    assert picture.grab().all()
    assert not first.any()
    with pytest.raises(ValueError, match="read-only"):
        first[0, 0, 0] = 1


@pytest.mark.parametrize("scale", [1, 3])
def test_a_text_has_its_shadow_one_gui_pixel_to_the_right_and_below(scale: int) -> None:
    frame = np.zeros((20 * scale, 60 * scale, 3), np.uint8)
    text = Letters(FONT, scale).text("Quit", 5, 6, WHITE, shadow=True)
    draw_all(frame, [text], (0, 0, 60 * scale, 20 * scale))
    ink, shadow = text_in(frame, WHITE), text_in(frame, SHADOW)
    moved = np.roll(ink, (scale, scale), (0, 1))
    assert ink.any()
    assert np.array_equal(shadow, moved & ~ink)
    assert np.flatnonzero(ink.any(1))[0] == 6 * scale
    assert np.flatnonzero(ink.any(0))[0] == 5 * scale


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
