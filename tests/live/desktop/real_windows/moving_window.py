"""A window of a drawn desktop."""

import numpy as np

from mc_nested.live.devices import DesktopArea, Frame


class MovingWindow:
    """A window on a desktop of one picture, of which each point is drawn as ``ratio`` x ``ratio`` pixels."""

    def __init__(self, area: DesktopArea, ratio: int = 1) -> None:
        self.at = area
        self.asked: list[DesktopArea] = []
        rows, columns = np.mgrid[0 : 60 * ratio, 0 : 80 * ratio]
        self.pixels = np.stack([rows, columns, rows + columns], axis=2).astype(np.uint8)
        self.ratio = ratio

    def title(self) -> str:
        return "Minecraft 1.21"

    def client_area(self) -> DesktopArea:
        return self.at

    def is_in_front(self) -> bool:
        return True

    def picture(self, area: DesktopArea) -> Frame:
        self.asked.append(area)
        top, left = area.top * self.ratio, area.left * self.ratio
        return self.pixels[top : top + area.height * self.ratio, left : left + area.width * self.ratio]
