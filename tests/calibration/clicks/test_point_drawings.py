"""Points drawn for a person: marked on their own screens, or on the one that is there."""

import cv2
import numpy as np

from calibration.clicks.point_drawings import (
    MARK_COLOUR,
    SEEN_COLOUR,
    TILE_WIDTH,
    picture_of_points,
    picture_of_screen,
)
from calibration.clicks.recorded_point import RecordedPoint
from mc_nested.live.devices import Frame
from sim.client.client import VirtualClient
from tests.calibration.contexts import started


def at(picture: Frame, x: int, y: int) -> tuple[int, ...]:
    return tuple(int(part) for part in picture[y, x])


def test_each_recorded_screen_is_a_tile_of_one_width_with_its_point_marked() -> None:
    wide, tall = np.full((480, 960, 3), 90, np.uint8), np.full((600, 300, 3), 90, np.uint8)
    picture = picture_of_points([RecordedPoint("one", (0.5, 0.5), wide), RecordedPoint("other", (0.25, 0.75), tall)])
    assert picture.shape == (320 + 1280, TILE_WIDTH, 3)
    assert at(picture, 320, 160) == at(picture, 160, 320 + 960) == MARK_COLOUR
    assert at(picture, 600, 300) == (90, 90, 90)
    # The name stands on a black strip above, as wide as the name and 16 pixels more.
    assert at(picture, 1, 1) == (0, 0, 0)
    strip = int((picture[1] != 0).any(axis=1).argmax())
    assert strip == cv2.getTextSize("one", cv2.FONT_HERSHEY_SIMPLEX, 0.6, 1)[0][0] + 16
    assert at(picture, 1, 28) == (90, 90, 90)


def test_the_current_screen_is_framed_by_what_was_recorded() -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    client.clock.sleep(0.3)
    frame = client.display.grab()
    here = RecordedPoint("here", (0.5, 0.325), frame).click_point(2)
    changed = np.rot90(frame, 2).copy()
    picture = picture_of_screen({"here": here}, frame)
    (x, y), (height, width) = here.position((854, 480)), here.picture.shape[:2]
    assert picture.shape == (480 + max(height, 24) + 8, 854, 3)
    assert at(picture, x - width // 2, y - height // 2) == SEEN_COLOUR
    assert at(picture, x + width // 2, y + height // 2) == SEEN_COLOUR
    assert at(picture, x, y) == SEEN_COLOUR
    for left, top in ((x - width // 2 - 3, y - height // 2), (x - width // 2, y - height // 2 - 3)):
        assert at(picture, left, top) != SEEN_COLOUR
    for right, bottom in ((x + width // 2 + 3, y + height // 2), (x + width // 2, y + height // 2 + 3)):
        assert at(picture, right, bottom) != SEEN_COLOUR
    assert np.array_equal(picture[484 : 484 + height, 4 : 4 + width], here.picture)
    assert at(picture, 1, 481) == (32, 32, 32)
    assert at(picture_of_screen({"here": here}, changed), x, y) == MARK_COLOUR
    assert np.array_equal(frame, client.display.grab()), "what was grabbed is not drawn on"
