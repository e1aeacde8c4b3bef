"""What the agents with objectives train on."""

import numpy as np
import pytest

from mc_nested.learn.objectives.drawn import drawn_design, drawn_obstacles, drawn_size


@pytest.mark.parametrize("size", [5, 9, 20])
def test_a_design_has_a_block_and_none_in_the_nearest_row(size: int) -> None:
    random = np.random.default_rng(size)
    designs = [drawn_design(random, size, 30) for _ in range(400)]
    assert min(map(len, designs)) >= 1
    assert all(0 <= x < size and 1 <= y < size for design in designs for x, y in design)


def test_designs_have_from_one_block_to_as_many_as_fit_nearly() -> None:
    random = np.random.default_rng(0)
    counts = [len(drawn_design(random, 6, 10)) for _ in range(3000)]
    assert min(counts) == 1
    assert max(counts) > 25  # of 30
    assert np.mean(np.array(counts) <= 10) > 0.8


def test_designs_of_every_kind_are_drawn() -> None:
    from mc_nested.arena.design import KINDS, kind_of_design

    random = np.random.default_rng(1)
    kinds = [kind_of_design(drawn_design(random, 12, 20)) for _ in range(300)]
    assert {kind: kinds.count(kind) >= 30 for kind in KINDS} == dict.fromkeys(KINDS, True)


def test_arenas_are_empty_or_hold_obstacles_and_often_the_near_rows_are_free() -> None:
    random = np.random.default_rng(2)
    stands = [drawn_obstacles(random, 10, 50) for _ in range(500)]
    shares = np.array([each.mean() for each in stands])
    assert (shares == 0).mean() > 0.1
    assert (shares > 0.1).mean() > 0.3
    assert shares.max() < 0.8
    assert np.mean([not each[:, 0].any() for each in stands]) > 0.4


def test_sizes_are_from_the_smallest_to_the_largest() -> None:
    random = np.random.default_rng(3)
    assert {drawn_size(random, 5, 9) for _ in range(300)} == {5, 6, 7, 8, 9}
