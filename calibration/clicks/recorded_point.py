"""A click point as it was recorded, with its whole screen."""

import dataclasses
from dataclasses import dataclass

from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import ClickPoint, record_point


@dataclass(frozen=True)
class RecordedPoint:
    """A recorded click point: fractions of the window's width and height, and the screen that it was recorded on."""

    name: str
    at: tuple[float, float]
    frame: Frame

    def click_point(self, scale: int) -> ClickPoint:
        """The point as a ClickPoint, at that GUI scale."""
        height, width = self.frame.shape[:2]
        pixel = min(round(self.at[0] * width), width - 1), min(round(self.at[1] * height), height - 1)
        return dataclasses.replace(record_point(self.name, self.frame, pixel, scale), at=self.at)
