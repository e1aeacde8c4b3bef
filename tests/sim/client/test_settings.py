import pytest

from sim.client.settings import gui_scale


@pytest.mark.parametrize(
    ("size", "wanted", "scale"),
    [
        ((854, 480), 0, 2),
        ((854, 480), 1, 1),
        ((854, 480), 3, 2),
        ((1280, 719), 0, 2),
        ((1280, 720), 0, 3),
        ((959, 720), 0, 2),
        ((960, 720), 4, 3),
        ((300, 200), 0, 1),
        ((300, 200), 2, 1),
    ],
)
def test_the_gui_scale_is_the_largest_that_fits_and_at_most_the_wanted_one(
    size: tuple[int, int], wanted: int, scale: int
) -> None:
    assert gui_scale(size, wanted) == scale
