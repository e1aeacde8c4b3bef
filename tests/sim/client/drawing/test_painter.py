import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.layout import Scales
from sim.client.client import VirtualClient
from sim.client.drawing.painter import WORLDS, ViewLayers, random_world
from sim.client.game.chat import TypedLine
from sim.client.game.edition import Edition
from sim.client.game.f3_screen import F3Screen
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.view import View
from tests.sim.client.playing import FONT, command

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


def test_a_chat_message_is_drawn_above_the_hotbar_and_gone_after_ten_seconds() -> None:
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


def test_a_stack_in_the_hotbar_is_drawn_in_its_slot() -> None:
    client = VirtualClient(world="dark")
    client.clock.sleep(0.1)
    empty = client.display.grab()
    client.realm.player.hotbar[8] = Stack("stone", 64)
    client.clock.sleep(0.1)
    changed = np.argwhere((client.display.grab() != empty).any(2)) / 2
    assert changed[:, 0].min() >= 240 - 22
    assert 213 + 69 <= changed[:, 1].min() <= changed[:, 1].max() <= 213 + 91


def test_hiding_the_hud_leaves_only_the_world() -> None:
    client = VirtualClient(world="flat")
    client.game.hides_hud = True
    client.clock.sleep(0.2)
    assert len(np.unique(client.display.grab().reshape(-1, 3), axis=0)) == 1


F3 = F3Screen("1.16-1.19.2", 2, (0.5, 64.0, 0.5), 0.0, 65.0)
HOTBAR = (Stack("stone", 64), *[None] * 8)


def layers() -> ViewLayers:
    return ViewLayers((854, 480), Scales(2, 2), FONT, Edition("1.16.5"), {})


def test_the_hotbar_the_debug_screen_and_the_typed_line_are_layers_over_the_world() -> None:
    shown = layers()
    counts = [
        len(shown.of(View(MenuState("world"), (0, 64, 0), f3, HOTBAR, typed=typed)))
        for f3, typed in ((None, None), (F3, None), (F3, TypedLine("/tp")))
    ]
    assert 0 < counts[0] < counts[1] < counts[2]


def test_only_the_menu_is_drawn_outside_a_world() -> None:
    shown = layers()
    title = MenuState("title")
    assert shown.of(View(title, (0, 0, 0), F3, HOTBAR, typed=TypedLine("/tp"))) == shown.of(View(title, (0, 0, 0)))


def test_an_unchanged_view_is_drawn_with_the_same_layers() -> None:
    shown = layers()
    view = View(MenuState("world"), (0, 64, 0), F3, HOTBAR)
    assert list(map(id, shown.of(view))) == list(map(id, shown.of(view)))


def world(kind: str, seed: int = 0) -> Frame:
    return random_world(np.random.default_rng(seed), kind, 50, 40)


@pytest.mark.parametrize("kind", [*WORLDS, "bright", "dark"])
def test_every_kind_of_world_has_the_given_size_and_depends_only_on_the_seed(kind: str) -> None:
    assert world(kind).shape == (40, 50, 3)
    assert world(kind).dtype == np.uint8
    assert np.array_equal(world(kind), world(kind))
    assert not np.array_equal(world(kind), world(kind, 1))


def test_a_flat_world_has_one_colour() -> None:
    assert len(np.unique(world("flat").reshape(-1, 3), axis=0)) == 1


def test_grey_noise_is_grey_and_noise_is_not() -> None:
    assert (world("grey noise") == world("grey noise")[..., :1]).all()
    assert not (world("noise") == world("noise")[..., :1]).all()


def test_a_noon_is_bright_and_a_night_is_dark() -> None:
    assert world("bright").min() >= 200
    assert world("dark").max() < 30


def test_a_gradient_changes_only_from_left_to_right() -> None:
    picture = world("gradient")
    assert (picture == picture[:1]).all()
    assert not (picture == picture[:, :1]).all()


def test_bright_specks_are_about_a_third_of_a_dark_grey() -> None:
    picture = random_world(np.random.default_rng(0), "specks", 400, 400)
    assert (picture == picture[..., :1]).all()
    dark, bright = np.unique(picture)
    assert (bright, bool(dark < 120)) == (224, True)
    assert 0.25 < (picture == 224).mean() < 0.35


@pytest.mark.parametrize("kind", ["bright", "dark"])
def test_a_sky_is_made_of_squares_of_16_pixels(kind: str) -> None:
    picture = world(kind)
    assert (picture[:16, :16] == picture[0, 0]).all()
    assert (picture[32:40, 48:50] == picture[32, 48]).all()
    assert not (picture[0, 15] == picture[0, 16]).all()
