"""Pictures of the game's window alone, wherever it has moved to."""

from collections.abc import Callable

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.window import GameWindow
from mc_nested.live.devices import DesktopArea, Frame, Region

Camera = Callable[[DesktopArea], Frame]
"""Takes a picture of an area of the desktop, at as many pixels to a point as the screen there has."""


class WindowDisplay:
    """The Display of a window: each picture is taken where the window is now."""

    def __init__(self, window: GameWindow, camera: Camera) -> None:
        self._window = window
        self._camera = camera
        self._ratio = 1.0
        self.grab()

    def ratio(self) -> float:
        """Return framebuffer pixels per point of the desktop, as the last whole picture measured it."""
        return self._ratio

    def area(self) -> DesktopArea:
        """Return where on the desktop the client area is now."""
        return self._window.client_area()

    def size(self) -> tuple[int, int]:
        area = self._window.client_area()
        return round(area.width * self._ratio), round(area.height * self._ratio)

    def title(self) -> str:
        return self._window.title()

    def is_in_front(self) -> bool:
        return self._window.is_in_front()

    def grab(self, region: Region | None = None) -> Frame:
        area = self._window.client_area()
        if region is not None and self._ratio == 1.0:
            part = _part_of(area, region)
            picture = self._camera(part)
            if picture.shape[:2] == (part.height, part.width):
                return picture
        picture = self._camera(area)
        self._ratio = picture.shape[1] / area.width
        if region is None:
            return picture
        inside = _part_of(DesktopArea(0, 0, picture.shape[1], picture.shape[0]), region)
        return picture[inside.top : inside.top + inside.height, inside.left : inside.left + inside.width]


def _part_of(area: DesktopArea, region: Region) -> DesktopArea:
    """Return the part of the client area that the region covers: nothing outside the window is ever pictured."""
    left, top = max(region.left, 0), max(region.top, 0)
    right, bottom = min(region.left + region.width, area.width), min(region.top + region.height, area.height)
    if right <= left or bottom <= top:
        raise DesktopError(f"the game's window has shrunk to {area.width} x {area.height}: make it as large as it was")
    return DesktopArea(area.left + left, area.top + top, right - left, bottom - top)
