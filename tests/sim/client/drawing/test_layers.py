import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from sim.client.drawing.layers import Blend, Gradient, Group, Ink, LayeredPicture, Rect, draw_all, intersection
from sim.client.game.widgets import WHITE, Colour


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
def test_intersection_returns_the_shared_rectangle_or_none(other: Rect, shared: Rect | None) -> None:
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


def test_draw_all_draws_later_layers_over_earlier_ones_and_only_inside_the_part() -> None:
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


class Note:
    """A layer that only notes which parts of it are drawn."""

    def __init__(self, rect: Rect) -> None:
        self.rect = rect
        self.parts: list[Rect] = []

    def draw(self, frame: Frame, part: Rect) -> None:
        frame[part[1] : part[3], part[0] : part[2]] += 1
        self.parts.append(part)


def test_layers_are_drawn_only_when_grabbed_and_only_in_the_grabbed_region() -> None:
    picture, upper, lower = (
        LayeredPicture(np.zeros((100, 50, 3), np.uint8)),
        Note((10, 10, 20, 20)),
        Note((10, 60, 20, 70)),
    )
    picture.show(np.zeros((100, 50, 3), np.uint8), [upper, lower])
    assert upper.parts == []
    part = picture.grab(Region(0, 15, 50, 10))
    assert upper.parts == [(10, 15, 20, 20)]
    assert lower.parts == []
    assert part.sum() == 5 * 10 * 3
    whole = picture.grab()
    assert whole.sum() == 2 * 10 * 10 * 3
    assert upper.parts == [(10, 15, 20, 20), (10, 10, 20, 15)]


def test_only_changed_layers_are_drawn_again() -> None:
    world = np.zeros((100, 50, 3), np.uint8)
    picture, kept, gone, new = LayeredPicture(world), Note((0, 0, 9, 9)), Note((0, 20, 9, 29)), Note((0, 40, 9, 49))
    picture.show(world, [kept, gone])
    before = picture.grab()
    picture.show(world, [kept, new])
    after = picture.grab()
    assert len(kept.parts) == len(gone.parts) == len(new.parts) == 1
    assert before[20:29].any()
    assert not after[20:29].any()
    assert after[40:49, :9].all()


def test_a_returned_picture_never_changes() -> None:
    world = np.zeros((10, 10, 3), np.uint8)
    picture = LayeredPicture(world)
    first = picture.grab()
    picture.show(world, [Blend((0, 0, 10, 10), WHITE, 255)])
    assert picture.grab().all()
    assert not first.any()
    with pytest.raises(ValueError, match="read-only"):
        first[0, 0, 0] = 1


def test_a_region_beside_the_window_is_cut_off() -> None:
    picture = LayeredPicture(np.full((10, 20, 3), 7, np.uint8))
    assert picture.grab(Region(15, -5, 50, 8)).shape == (3, 5, 3)
    assert picture.grab(Region(15, -5, 50, 8)).min() == 7
    assert picture.grab(Region(20, 0, 5, 5)).shape == (0, 0, 3)


def test_grabbing_a_region_again_returns_the_same_array() -> None:
    world = np.zeros((10, 20, 3), np.uint8)
    picture = LayeredPicture(world)
    first = picture.grab(Region(0, 0, 5, 5))
    assert picture.grab(Region(0, 0, 5, 5)) is first
    assert picture.grab(Region(0, 0, 5, 6)) is not first
    picture.show(world, [])
    assert picture.grab(Region(0, 0, 5, 6)) is not first


def test_a_new_background_is_drawn_as_a_whole() -> None:
    picture = LayeredPicture(np.zeros((10, 20, 3), np.uint8))
    picture.grab()
    layer = Note((2, 2, 4, 4))
    picture.show(np.full((10, 20, 3), 9, np.uint8), [layer])
    shown = picture.grab()
    assert shown[0, 0, 0] == 9
    assert shown[2, 2, 0] == 10
    assert layer.parts == [(2, 2, 4, 4)]


def test_rows_outside_a_grabbed_region_are_drawn_when_they_are_grabbed() -> None:
    world = np.zeros((12, 20, 3), np.uint8)
    picture, layer = LayeredPicture(world), Note((0, 0, 20, 12))
    picture.grab()
    picture.show(world, [layer])
    picture.grab(Region(0, 4, 20, 4))
    assert layer.parts == [(0, 4, 20, 8)]
    picture.grab(Region(0, 4, 20, 4))
    assert layer.parts == [(0, 4, 20, 8)]
    assert picture.grab().min() == 1
    assert sorted(layer.parts) == [(0, 0, 20, 4), (0, 4, 20, 8), (0, 8, 20, 12)]


def test_overlapping_changes_are_drawn_once() -> None:
    world = np.zeros((12, 20, 3), np.uint8)
    picture = LayeredPicture(world)
    picture.grab()
    inner, outer, inner_again = Note((4, 4, 8, 8)), Note((2, 2, 10, 10)), Note((4, 4, 8, 8))
    picture.show(world, [inner, outer, inner_again])
    assert picture.grab().max() == 3
    assert (inner.parts, outer.parts, inner_again.parts) == ([(4, 4, 8, 8)], [(2, 2, 10, 10)], [(4, 4, 8, 8)])


def test_a_layer_beyond_the_window_is_drawn_up_to_its_edge() -> None:
    world = np.zeros((10, 20, 3), np.uint8)
    picture, layer, beyond = LayeredPicture(world), Note((-5, -5, 3, 3)), Note((30, 30, 40, 40))
    picture.grab()
    picture.show(world, [layer, beyond])
    picture.grab()
    assert (layer.parts, beyond.parts) == ([(0, 0, 3, 3)], [])


def test_columns_outside_a_grabbed_region_are_drawn_when_they_are_grabbed() -> None:
    picture, layer = LayeredPicture(np.zeros((20, 40, 3), np.uint8)), Note((0, 0, 40, 20))
    picture.show(np.zeros((20, 40, 3), np.uint8), [layer])
    assert picture.grab(Region(8, 5, 4, 6)).all()
    assert layer.parts == [(8, 5, 12, 11)]
    assert (picture.grab() == 1).all()  # each pixel once


def test_each_of_two_regions_stays_the_same_array_until_something_changes() -> None:
    world = np.zeros((20, 40, 3), np.uint8)
    picture = LayeredPicture(world)
    regions = Region(0, 0, 40, 5), Region(0, 10, 40, 5)
    first, second = (picture.grab(region) for region in regions)
    assert picture.grab(regions[0]) is first
    assert picture.grab(regions[1]) is second
    picture.show(world, [Blend((0, 0, 40, 20), WHITE, 255)])
    assert picture.grab(regions[0]) is not first
