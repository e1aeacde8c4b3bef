"""How far a held key walks, against the facts' table."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.walk import displacement, nearest_ticks, walk_response


@pytest.mark.parametrize(("ticks", "blocks"), [(1, 0.210), (2, 0.427), (3, 0.642), (4, 0.857), (5, 1.073), (6, 1.291)])
def test_walking_and_coasting_covers_what_the_facts_say(ticks: int, blocks: float) -> None:
    assert displacement(ticks) == pytest.approx(blocks, abs=0.0006)


def test_no_tick_walks_nowhere() -> None:
    assert displacement(0) == 0.0


def test_a_long_walk_ends_at_the_steady_speed() -> None:
    assert (displacement(101) - displacement(100)) * 20 == pytest.approx(4.317, abs=0.001)


def test_one_block_takes_five_ticks() -> None:
    assert nearest_ticks(1.0, walk_response(12)) == 5


def test_standing_still_is_nearest_to_a_hair() -> None:
    assert nearest_ticks(0.1, walk_response(12)) == 0


@given(st.floats(0.0, 2.58))
def test_the_nearest_hold_ends_within_half_a_tick_of_walking(distance: float) -> None:
    response = walk_response(12)
    ends = (0.0, *response)
    assert abs(ends[nearest_ticks(distance, response)] - distance) <= 0.1093
