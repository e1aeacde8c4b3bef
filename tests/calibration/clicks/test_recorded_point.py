"""A recorded point as one that can be clicked."""

import numpy as np
import pytest

from calibration.clicks.by_hand import largest_scale
from calibration.clicks.recorded_point import RecordedPoint

FRAME = np.arange(480 * 854 * 3, dtype=np.uint32).astype(np.uint8).reshape(480, 854, 3)


@pytest.mark.parametrize(
    ("at", "rows", "columns"),
    [
        ((0.5, 0.5), slice(230, 250), slice(331, 523)),
        ((1.0, 1.0), slice(469, 480), slice(757, 854)),
        ((0.0, 0.0), slice(0, 10), slice(0, 96)),
    ],
)
def test_its_picture_is_what_lies_around_it_and_within_the_window(
    at: tuple[float, float], rows: slice, columns: slice
) -> None:
    point = RecordedPoint("world", at, FRAME).click_point(2)
    assert (point.name, point.at) == ("world", at)
    assert np.array_equal(point.picture, FRAME[rows, columns])


@pytest.mark.parametrize(
    ("size", "scale"),
    [((854, 480), 2), ((639, 480), 1), ((640, 479), 1), ((100, 100), 1), ((1920, 1080), 4), ((3840, 2160), 4)],
)
def test_the_game_picks_the_largest_gui_scale_that_fits(size: tuple[int, int], scale: int) -> None:
    assert largest_scale(*size) == scale
