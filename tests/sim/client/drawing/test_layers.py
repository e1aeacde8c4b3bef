import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.drawing.layers import Blend, Gradient, Group, Ink, Rect, draw_all, intersection
from sim.client.game.colours import Colour


def grey(value: int, height: int = 10, width: int = 20) -> Frame:
    return np.full((height, width, 3), value, np.uint8)


@pytest.mark.parametrize(
    ("other", "shared"),
    [
        ((5, 6, 30, 40), (5, 6, 10, 20)),
        ((-5, -5, 2, 3), (0, 0, 2, 3)),
        ((2, 3, 4, 5), (2, 3, 4, 5)),
        ((10, 0, 20, 20), None),
        ((0, 20, 10, 30), None),
        ((-5, 0, 0, 20), None),
    ],
)
def test_two_rectangles_share_what_lies_in_both(other: Rect, shared: Rect | None) -> None:
    assert intersection((0, 0, 10, 20), other) == shared
    assert intersection(other, (0, 0, 10, 20)) == shared


@pytest.mark.parametrize(
    ("colour", "alpha", "expected"),
    [
        ((10, 20, 30), 255, [30, 20, 10]),
        ((10, 20, 30), 0, [100, 100, 100]),
        ((200, 100, 0), 51, [80, 100, 120]),
        ((0, 0, 0), 51, [80, 80, 80]),
        ((200, 200, 200), 51, [120, 120, 120]),
    ],
)
def test_a_blend_mixes_its_colour_with_what_is_behind(colour: Colour, alpha: int, expected: list[int]) -> None:
    frame = grey(100)
    draw_all(frame, [Blend((3, 2, 6, 4), colour, alpha)], (0, 0, 20, 10))
    assert frame[2:4, 3:6].reshape(-1, 3).tolist() == [expected] * 6
    frame[2:4, 3:6] = 100
    assert (frame == 100).all()


def test_a_gradient_changes_from_top_to_bottom() -> None:
    frame = grey(100, 4, 1)
    layer = Gradient((0, 0, 1, 4), ((0, 0, 0), 0), ((200, 100, 0), 255))
    draw_all(frame, [layer], (0, 0, 1, 4))
    # A share of 0, 1/4, 2/4 and 3/4 of the way: the alpha and the colour both change.
    assert frame[:, 0].tolist() == [[100, 100, 100], [75, 81, 88], [50, 75, 100], [25, 81, 138]]


def test_a_part_of_a_gradient_is_that_part_of_the_whole() -> None:
    layer = Gradient((0, 2, 20, 10), ((80, 0, 0), 96), ((128, 48, 48), 160))
    whole, part = grey(90), grey(90)
    draw_all(whole, [layer], (0, 0, 20, 10))
    draw_all(part, [layer], (0, 5, 20, 8))
    assert np.array_equal(part[5:8], whole[5:8])
    assert (part[:5] == 90).all()
    assert (part[8:] == 90).all()


def test_ink_hides_the_background_at_its_dots_alone() -> None:
    mask, colours = np.zeros((2, 2), np.uint8), np.full((2, 2, 3), (1, 2, 3), np.uint8)
    mask[0, 1] = 255
    frame = grey(100)
    draw_all(frame, [Ink((4, 5, 6, 7), lambda: (mask, colours))], (0, 0, 20, 10))
    assert frame[5, 5].tolist() == [1, 2, 3]
    frame[5, 5] = 100
    assert (frame == 100).all()
    draw_all(frame, [Ink((4, 5, 6, 7), lambda: (mask, colours))], (5, 5, 6, 6))
    assert frame[5, 5].tolist() == [1, 2, 3]


def test_a_group_is_as_large_as_its_layers_and_draws_them_in_their_order() -> None:
    group = Group((Blend((3, 2, 6, 4), (10, 10, 10), 255), Blend((5, 1, 9, 3), (20, 20, 20), 255)))
    assert group.rect == (3, 1, 9, 4)
    frame = grey(0)
    draw_all(frame, [group], (4, 2, 20, 10))
    assert frame[2, 3:10, 0].tolist() == [0, 10, 20, 20, 20, 20, 0]
    assert not frame[1].any()


def test_later_layers_are_over_earlier_ones_and_only_in_the_part() -> None:
    frame = grey(0)
    layers = [Blend((0, 0, 20, 10), (10, 10, 10), 255), Blend((5, 0, 20, 10), (20, 20, 20), 255)]
    draw_all(frame, layers, (4, 3, 7, 5))
    assert frame[3, 3:8, 0].tolist() == [0, 10, 20, 20, 0]
    assert frame[2:6, 4, 0].tolist() == [0, 10, 10, 0]


@pytest.mark.parametrize("rect", [(0, 0, 4, 10), (7, 0, 20, 10), (0, 0, 20, 3), (0, 5, 20, 10)])
def test_a_layer_that_only_touches_the_part_is_not_drawn(rect: Rect) -> None:
    frame = grey(0)
    draw_all(frame, [Blend(rect, (9, 9, 9), 255)], (4, 3, 7, 5))
    assert not frame.any()
