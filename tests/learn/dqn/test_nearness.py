"""How near the cells are to some sources, and its slopes, checked by hand and by finite differences."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mc_nested.learn.dqn.nearness import FROM_ITSELF, slopes, spread


def test_nearness_spreads_past_what_stands_and_a_cell_that_cant_be_reached_has_none() -> None:
    passing = np.full((1, 5, 5), 0.5, np.float32)
    passing[0, 1, :4] = 0.0  # a wall with a gap at its far end
    passing[0, :, 4] = [0.5, 0.5, 0.5, 0.0, 0.5]
    sources = np.zeros((1, 5, 5), np.float32)
    sources[0, 0, 0] = 1.0
    near = spread(sources, passing)[0][0]
    assert near[0, 4] == 0.5**4
    assert near[2, 4] == 0.5**6  # round the wall, not through it
    assert near[2, 2] == 0.5**8
    assert near[1, 0] == near[3, 4] == 0.0


def test_a_way_may_be_as_long_as_it_must() -> None:
    side = 9
    passing = np.zeros((1, side, side), np.float32)
    passing[0, ::2, :] = 1.0  # rows that are joined at one end and at the other, in turns
    passing[0, 1::4, -1] = passing[0, 3::4, 0] = 1.0
    sources = np.zeros_like(passing)
    sources[0, 0, 0] = 1.0
    near = spread(sources, passing)[0][0]
    assert near[-1, -1] == 1.0


def test_a_cell_has_its_nearness_from_the_nearer_neighbour() -> None:
    sources = np.zeros((1, 3, 3), np.float32)
    sources[0, 0, 1], sources[0, 2, 1] = 0.5, 1.0
    near, via = spread(sources, np.full((1, 3, 3), 0.5, np.float32))
    assert via[0, 2, 1] == via[0, 0, 1] == FROM_ITSELF
    assert via[0, 1, 1] == 2 * 3 + 1
    assert near[0, 1, 1] == 0.5


def test_slopes_of_a_line_are_those_of_a_product() -> None:
    passing = np.array([[[1.0, 0.5, 0.25], [0, 0, 0], [0, 0, 0]]], np.float32)
    sources = np.zeros_like(passing)
    sources[0, 0, 0] = 0.8
    near, via = spread(sources, passing)
    of_near = np.zeros_like(near)
    of_near[0, 0, 2] = 1.0  # 0.8 * 0.5 * 0.25
    of_sources, of_passing = slopes(passing, near, via, of_near)
    np.testing.assert_allclose(of_sources[0, 0], [0.5 * 0.25, 0, 0])
    np.testing.assert_allclose(of_passing[0, 0], [0, 0.8 * 0.25, 0.8 * 0.5])


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 1000))
def test_slopes_are_what_finite_differences_say(seed: int) -> None:
    random = np.random.default_rng(seed)
    shape = (2, 5, 5)
    sources = (random.random(shape) * (random.random(shape) < 0.2)).astype(np.float32)
    passing = random.uniform(0.2, 0.9, shape).astype(np.float32)
    of_near = random.normal(size=shape).astype(np.float32)
    near, via = spread(sources, passing)
    of_sources, of_passing = slopes(passing, near, via, of_near)
    step = 1e-3
    for which, found in ((0, of_sources), (1, of_passing)):
        run, x, y = random.integers(0, shape)
        both = [sources.copy(), passing.copy()]
        both[which][run, x, y] += step
        after, others = spread(both[0], both[1])
        if np.array_equal(others, via):  # otherwise a nearest neighbour changed, and with it the slope
            change = float(((after - near).astype(np.float64) * of_near).sum()) / step
            np.testing.assert_allclose(found[run, x, y], change, atol=5e-3, rtol=1e-2)
