import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from sim.client.drawing.layers import Rect
from sim.window.window_picture import TILE, triangles

SIZE = (70, 50)
SIDES = st.tuples(st.integers(-20, 90), st.integers(-20, 90)).map(sorted)


def covered(rects: list[Rect]) -> np.ndarray[tuple[int, ...], np.dtype[np.int_]]:
    """Return how many of the triangles' pairs lie over each pixel."""
    counts = np.zeros((SIZE[1], SIZE[0]), int)
    pairs = triangles(rects, SIZE).reshape(-1, 6, 2)
    for pair in (pairs - (-1, 1)) / (1, -1) * SIZE / 2:
        left, top = np.rint(pair.min(axis=0)).astype(int)
        right, bottom = np.rint(pair.max(axis=0)).astype(int)
        counts[top:bottom, left:right] += 1
    return counts


@given(st.lists(st.tuples(SIDES, SIDES), max_size=6))
def test_triangles_cover_each_pixel_of_the_rectangles_once_and_no_other_tile(
    sides: list[tuple[list[int], ...]],
) -> None:
    rects = [(x[0], y[0], x[1], y[1]) for x, y in sides]
    counts = covered(rects)
    wanted = np.zeros((SIZE[1], SIZE[0]), bool)
    for left, top, right, bottom in rects:
        wanted[max(top, 0) : max(bottom, 0), max(left, 0) : max(right, 0)] = True
    assert counts.max() <= 1
    assert counts[wanted].all()
    for top in range(0, SIZE[1], TILE):
        for left in range(0, SIZE[0], TILE):
            tile = np.s_[top : top + TILE, left : left + TILE]
            assert counts[tile].any() == wanted[tile].any()


def test_no_triangles_are_made_without_rectangles() -> None:
    assert triangles([], SIZE).shape == (0, 2)


def test_a_rectangle_over_the_whole_window_needs_two_triangles_a_row() -> None:
    assert len(triangles([(0, 0, *SIZE)], SIZE)) == 6 * 4
