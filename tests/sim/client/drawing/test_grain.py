import numpy as np

from sim.client.drawing.grain import GRAIN_BLOCKS, grain


def test_each_face_has_sixteen_dots_a_side_and_a_darker_rim() -> None:
    dots = grain()
    assert dots.shape == (16 * GRAIN_BLOCKS, 16 * GRAIN_BLOCKS)
    assert dots.max() <= 1.0
    inside, rim = dots[1:15, 1:15], dots[0, :16]
    assert inside.mean() - rim.mean() > 0.1
    assert np.array_equal(dots, grain()), "it is always the same"
