"""The real mouse: with a made-up pyautogui and pynput, and over a real window under Xvfb."""

import sys

import pytest

from mc_nested.errors import DesktopError, LiveError
from mc_nested.live.desktop.lost_display import LOST
from mc_nested.live.desktop.pointer import DesktopPointer, load_pyautogui
from mc_nested.live.devices import DesktopArea
from tests.live.desktop.fake_devices import Buttons, Mouse, install_mouse, install_pynput
from tests.live.desktop.real_windows.moving_window import MovingWindow
from tests.live.desktop.real_windows.probed import glfw_probed, probed


@pytest.fixture
def mouse(monkeypatch: pytest.MonkeyPatch) -> Mouse:
    return install_mouse(monkeypatch)


@pytest.fixture
def buttons(monkeypatch: pytest.MonkeyPatch) -> Buttons:
    buttons = Buttons()
    install_pynput(monkeypatch, buttons)
    return buttons


def pointer_over(area: DesktopArea, ratio: float = 1.0) -> DesktopPointer:
    return DesktopPointer(MovingWindow(area), lambda: ratio)


@pytest.mark.usefixtures("buttons")
def test_positions_count_pixels_from_the_client_areas_corner(mouse: Mouse) -> None:
    pointer = pointer_over(DesktopArea(60, 40, 320, 240))
    pointer.move(200, 50)
    assert mouse.at == (260, 90)
    assert pointer.position() == (200, 50)


@pytest.mark.usefixtures("buttons")
def test_positions_are_in_pixels_on_a_retina_screen_too(mouse: Mouse) -> None:
    pointer = pointer_over(DesktopArea(60, 40, 320, 240), ratio=2.0)
    pointer.move(201, 50)
    assert mouse.at == (160.5, 65)
    assert pointer.position() == (201, 50)


@pytest.mark.usefixtures("mouse")
def test_pynput_presses_and_releases_a_button_without_moving_the_mouse(buttons: Buttons) -> None:
    pointer = pointer_over(DesktopArea(60, 40, 320, 240))
    pointer.press("right")
    pointer.release("right")
    assert buttons.sent == [("down", "right"), ("up", "right")]


@pytest.mark.parametrize("corner", [(0, 0), (1023, 767)])
def test_a_button_in_a_screen_corner_can_be_released_but_not_pressed(
    corner: tuple[int, int], mouse: Mouse, buttons: Buttons
) -> None:
    mouse.at = corner
    pointer = pointer_over(DesktopArea(60, 40, 320, 240))
    with pytest.raises(LiveError, match="means stop: nothing was clicked"):
        pointer.press("left")
    pointer.release("left")
    assert buttons.sent == [("up", "left")]


@pytest.mark.skipif(not LOST, reason="the display of an X server")
@pytest.mark.usefixtures("mouse")
def test_pressing_without_a_display_is_an_error_but_releasing_is_not(buttons: Buttons) -> None:
    buttons.has_display = False
    pointer = pointer_over(DesktopArea(60, 40, 320, 240))
    with pytest.raises(DesktopError, match="display has closed"):
        pointer.press("left")
    pointer.release("left")


def test_pyautogui_has_no_pause_or_fail_safe_and_its_extras_are_importable_again(
    mouse: Mouse, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("mouseinfo", "pyscreeze"):
        monkeypatch.setitem(sys.modules, name, sys)
        del sys.modules[name]
    assert load_pyautogui() is mouse
    assert (mouse.PAUSE, mouse.FAILSAFE) == (0, False)
    assert not {"mouseinfo", "pyscreeze"} & set(sys.modules)


@pytest.mark.standin
def test_a_real_window_is_pointed_at_and_clicked(x_server: dict[str, str]) -> None:
    report = probed(x_server, "pointer")
    assert report["pointer"] == [200, 50]
    assert report["clicks"] == [["down", 3, False, 200, 50], ["up", 3, False, 200, 50]]
    assert "means stop" in report["in the corner"]


if sys.platform.startswith("linux"):

    @pytest.mark.window
    def test_a_hundred_clicks_do_not_move_a_held_mouse(x_screen: dict[str, str]) -> None:
        assert glfw_probed(x_screen, "clicks") == {"has raw motion": True, "moves": True, "button": 200, "cursor": 0}
