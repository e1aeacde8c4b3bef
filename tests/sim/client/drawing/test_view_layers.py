from mc_nested.live.model.scales import Scales
from sim.client.drawing.view_layers import ViewLayers
from sim.client.game.chat import TypedLine
from sim.client.game.edition import Edition
from sim.client.game.f3_screen import F3Screen
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState
from sim.client.game.view import View
from tests.sim.client.playing import FONT

F3 = F3Screen("1.16-1.19.2", 2, (0.5, 64.0, 0.5), 0.0, 65.0)
HOTBAR = (Stack("stone", 64), *[None] * 8)


def layers() -> ViewLayers:
    return ViewLayers((854, 480), Scales(2, 2), FONT, Edition("1.16.5"), {})


def test_in_the_world_there_are_hotbar_debug_screen_and_typed_line() -> None:
    shown = layers()
    counts = [
        len(shown.of(View(MenuState("world"), (0, 64, 0), f3, HOTBAR, typed=typed)))
        for f3, typed in ((None, None), (F3, None), (F3, TypedLine("/tp")))
    ]
    assert 0 < counts[0] < counts[1] < counts[2]


def test_outside_a_world_there_is_the_menu_alone() -> None:
    shown = layers()
    title = MenuState("title")
    assert shown.of(View(title, (0, 0, 0), F3, HOTBAR, typed=TypedLine("/tp"))) == shown.of(View(title, (0, 0, 0)))


def test_what_did_not_change_is_the_same_layer_again() -> None:
    shown = layers()
    view = View(MenuState("world"), (0, 64, 0), F3, HOTBAR)
    assert list(map(id, shown.of(view))) == list(map(id, shown.of(view)))
