"""Pictures of the game's window, wherever it is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.display import WindowDisplay
from mc_nested.live.devices import DesktopArea, Frame, Region
from tests.live.desktop.real_windows.moving_window import MovingWindow


@st.composite
def regions(draw: st.DrawFn, width: int, height: int) -> Region:
    left, top = draw(st.integers(0, width - 1)), draw(st.integers(0, height - 1))
    return Region(left, top, draw(st.integers(1, width - left)), draw(st.integers(1, height - top)))


@pytest.mark.parametrize("ratio", [1, 2], ids=["points are pixels", "two pixels to a point"])
@given(data=st.data())
def test_grabbing_a_region_gives_that_part_of_the_whole_picture_wherever_the_window_is(
    ratio: int, data: st.DataObject
) -> None:
    window = MovingWindow(DesktopArea(5, 7, 40, 30), ratio)
    display = WindowDisplay(window, window.picture)
    window.at = DesktopArea(data.draw(st.integers(0, 40)), data.draw(st.integers(0, 30)), 40, 30)
    width, height = display.size()
    region = data.draw(regions(width, height))
    whole = display.grab()
    expected = whole[region.top : region.top + region.height, region.left : region.left + region.width]
    np.testing.assert_array_equal(display.grab(region), expected)


def test_the_camera_pictures_only_the_requested_region_where_points_are_pixels() -> None:
    window = MovingWindow(DesktopArea(5, 7, 40, 30))
    WindowDisplay(window, window.picture).grab(Region(1, 2, 10, 4))
    assert window.asked[-1] == DesktopArea(6, 9, 10, 4)


def test_the_size_is_in_pixels_of_the_windows_screen() -> None:
    window = MovingWindow(DesktopArea(5, 7, 40, 30), ratio=2)
    display = WindowDisplay(window, window.picture)
    assert (display.size(), (display.area().width, display.area().height)) == ((80, 60), (40, 30))


def test_a_region_is_cut_to_the_window_and_refused_outside_it() -> None:
    window = MovingWindow(DesktopArea(5, 7, 40, 30))
    display = WindowDisplay(window, window.picture)
    assert display.grab(Region(30, -3, 500, 500)).shape == (30, 10, 3)
    with pytest.raises(DesktopError, match="shrunk"):
        display.grab(Region(40, 0, 5, 5))


def test_the_display_has_the_title_and_focus_of_its_window() -> None:
    display = WindowDisplay(MovingWindow(DesktopArea(5, 7, 40, 30)), lambda area: picture_of(area, 1))
    assert (display.title(), display.is_in_front()) == ("Minecraft 1.21", True)


def picture_of(area: DesktopArea, ratio: int) -> Frame:
    return np.zeros((area.height * ratio, area.width * ratio, 3), np.uint8)


def test_a_window_that_moves_to_a_finer_screen_is_measured_again() -> None:
    ratio = 1
    display = WindowDisplay(MovingWindow(DesktopArea(5, 7, 40, 30)), lambda area: picture_of(area, ratio))
    assert display.ratio() == 1.0
    ratio = 2
    assert display.grab(Region(0, 0, 10, 10)).shape == (10, 10, 3)
    assert (display.ratio(), display.size()) == (2.0, (80, 60))


@pytest.mark.parametrize("region", [Region(-5, 0, 5, 5), Region(0, 30, 5, 5), Region(0, -5, 5, 5), Region(3, 3, 0, 5)])
def test_a_region_that_only_touches_the_window_is_an_error(region: Region) -> None:
    display = WindowDisplay(MovingWindow(DesktopArea(5, 7, 40, 30)), lambda area: picture_of(area, 1))
    with pytest.raises(DesktopError, match="has shrunk to 40 x 30"):
        display.grab(region)
