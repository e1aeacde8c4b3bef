"""Beliefs about each cell, by hand on a small arena, and how optimism makes an agent try unknown cells."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arrays import Int64s
from mc_nested.learn.imagination.beliefs import FAR_FROM_PAYING, KNOWN_TO_PAY, Belief, Beliefs, believe, evidence_of
from mc_nested.learn.imagination.experience import RealStep

SIZE = 5
AHEAD = (0, 1)
UNKNOWN, BELIEVED, PAYS, PAYS_NOT = Belief


def tries(*tried: tuple[Cell, bool]) -> Int64s:
    """Return a transition for each block that landed in a cell, ahead of the agent, and whether it paid."""
    steps = [RealStep(x, y - 1, 9, int(Action.FD), x, y - 1, 8, int(paid), 0) for (x, y), paid in tried]
    return np.array(steps, dtype=np.int64).reshape(len(steps), 9)


def of(*tried: tuple[Cell, bool], blocks: int = 3) -> Beliefs:
    return believe(evidence_of(tries(*tried), AHEAD, SIZE), AHEAD, blocks)


def test_at_first_every_cell_is_unknown_and_every_reachable_cell_may_pay() -> None:
    found = of(blocks=2)
    assert (found.cells == UNKNOWN).all()
    # Nobody stands in front of the row y = 0: no block lands there.
    assert found.pay[:, 0].tolist() == [0.0] * SIZE
    assert (found.pay[:, 1:] == 1.0).all()
    assert found.explores
    assert found.most == 2.0


def test_the_eight_cells_around_a_paying_one_are_believed_to_pay() -> None:
    found = of(((2, 3), True))
    assert found.cells.tolist() == [
        [UNKNOWN] * 5,
        [UNKNOWN, UNKNOWN, BELIEVED, BELIEVED, BELIEVED],
        [UNKNOWN, UNKNOWN, BELIEVED, PAYS, BELIEVED],
        [UNKNOWN, UNKNOWN, BELIEVED, BELIEVED, BELIEVED],
        [UNKNOWN] * 5,
    ]
    known, far = np.float32(KNOWN_TO_PAY), np.float32(FAR_FROM_PAYING)
    assert found.pay[1].tolist() == [0.0, far, 1.0, 1.0, 1.0]
    assert found.pay[2].tolist() == [0.0, far, 1.0, known, 1.0]
    assert found.most == 3.0, "three believed cells: more than with the known one"


def test_cells_that_no_block_can_reach_are_not_believed_to_pay() -> None:
    found = of(((2, 1), True))
    assert found.cells[:, 0].tolist() == [UNKNOWN] * SIZE
    assert found.pay[:, 0].tolist() == [0.0] * SIZE
    assert found.cells[1:4, 2].tolist() == [BELIEVED] * 3


@pytest.mark.parametrize(
    ("lands", "unreached"),
    [
        ((0, 1), {(x, 0) for x in range(SIZE)}),
        ((1, 0), {(0, y) for y in range(SIZE)}),
        ((-1, -1), {(x, y) for x in range(SIZE) for y in range(SIZE) if 4 in (x, y)}),
    ],
)
def test_the_cells_in_reach_depend_on_where_blocks_land(lands: Cell, unreached: set[Cell]) -> None:
    pay = believe(evidence_of(tries(), lands, SIZE), lands, 3).pay
    assert {(int(x), int(y)) for x, y in np.argwhere(pay == 0.0)} == unreached


def test_a_cell_that_paid_nothing_is_worth_nothing() -> None:
    found = of(((2, 3), True), ((2, 4), False))
    assert found.cells[2, 4] == PAYS_NOT
    assert found.pay[2, 4] == 0.0


def test_every_unknown_cell_may_pay_once_all_cells_beside_a_paying_one_were_tried() -> None:
    # The only cells beside (0, 1) in reach are (0, 2), (1, 1) and (1, 2): none of them paid.
    found = of(((0, 1), True), ((0, 2), False), ((1, 1), False), ((1, 2), False))
    assert not (found.cells == BELIEVED).any()
    assert found.pay[2:, 1:].tolist() == [[1.0] * 4] * 3
    assert found.pay[0, 1] == np.float32(KNOWN_TO_PAY)


def test_only_known_paying_cells_pay_once_there_are_as_many_as_blocks() -> None:
    found = of(((1, 3), True), ((4, 4), False), ((2, 3), True), blocks=2)
    assert not found.explores
    assert np.argwhere(found.pay > 0).tolist() == [[1, 3], [2, 3]]
    assert found.pay.sum() == found.most == 2.0
    assert set(found.cells.ravel().tolist()) == {UNKNOWN, PAYS, PAYS_NOT}


@pytest.mark.parametrize("before", range(2, 12))
@pytest.mark.parametrize("usual", [True, False])
def test_one_odd_outcome_is_outvoted_and_two_in_a_row_are_believed(usual: bool, before: int) -> None:
    belief = {True: PAYS, False: PAYS_NOT}
    cell = (2, 2)
    said = [(cell, usual)] * before
    assert of(*said).cells[cell] == belief[usual]
    assert of(*said, (cell, not usual)).cells[cell] == belief[usual]
    assert of(*said, (cell, not usual), (cell, usual)).cells[cell] == belief[usual]
    assert of(*said, (cell, not usual), (cell, not usual)).cells[cell] == belief[not usual]


def test_the_later_of_two_outcomes_counts() -> None:
    assert of(((2, 2), True), ((2, 2), False)).cells[2, 2] == PAYS_NOT
    assert of(((2, 2), False), ((2, 2), True)).cells[2, 2] == PAYS


def test_a_step_that_used_no_block_changes_no_belief() -> None:
    steps = tries(((2, 2), False))
    steps[:, 6] = steps[:, 2]
    assert (believe(evidence_of(steps, AHEAD, SIZE), AHEAD, 3).cells == UNKNOWN).all()


def test_a_block_outside_the_arena_changes_no_belief() -> None:
    assert (believe(evidence_of(tries(((2, 3), True)), (0, 3), SIZE), (0, 3), 3).cells == UNKNOWN).all()


@given(
    st.lists(st.tuples(st.tuples(st.integers(0, 4), st.integers(1, 4)), st.booleans()), max_size=40), st.integers(1, 8)
)
def test_pay_agrees_with_the_belief_about_every_cell(tried: list[tuple[Cell, bool]], blocks: int) -> None:
    found = of(*tried, blocks=blocks)
    pays, unknown = found.cells == PAYS, np.isin(found.cells, [UNKNOWN, BELIEVED])
    assert set(map(tuple, np.argwhere(~unknown).tolist())) == {cell for cell, _ in tried}
    assert found.explores == (pays.sum() < blocks)
    assert not found.pay[found.cells == PAYS_NOT].any()
    assert (found.pay[:, 1:][unknown[:, 1:]] > 0).all() == found.explores or not unknown[:, 1:].any()
    assert (found.pay[found.cells == BELIEVED] == 1.0).all()
    best = sorted(found.pay.astype(np.float64).ravel(), reverse=True)[:blocks]
    assert found.most == sum(best), "what an imagined episode can earn, to the last bit"


def test_cells_probed_by_other_games_stay_unknown_and_are_taken_to_pay_nothing() -> None:
    beside = [(1, 2), (2, 2), (3, 2)]
    found = believe(evidence_of(tries(((2, 3), True)), AHEAD, SIZE), AHEAD, 3, elsewhere=beside)
    assert all(found.cells[cell] == UNKNOWN and found.pay[cell] == 0.0 for cell in beside)
    assert found.cells[1, 3] == BELIEVED
    assert found.pay[1, 3] == 1.0
    assert found.explores


def test_unknown_cells_may_pay_while_other_games_probe_all_cells_beside_a_paying_one() -> None:
    around = [(x, y) for x in (1, 2, 3) for y in (2, 3, 4) if (x, y) != (2, 3)]
    found = believe(evidence_of(tries(((2, 3), True)), AHEAD, SIZE), AHEAD, 3, elsewhere=around)
    assert (found.cells != BELIEVED).all()
    assert found.pay[4, 4] == 1.0


def test_tried_cells_stay_known_while_other_games_probe_them() -> None:
    tried = tries(((2, 3), True), ((1, 1), False))
    found = believe(evidence_of(tried, AHEAD, SIZE), AHEAD, 3, elsewhere=[(2, 3), (1, 1)])
    np.testing.assert_array_equal(found.pay, of(((2, 3), True), ((1, 1), False)).pay)


def test_unknown_cells_are_probed_again_when_other_games_probe_all_of_them() -> None:
    every = [(x, y) for x in range(SIZE) for y in range(1, SIZE)]
    found = believe(evidence_of(tries(((2, 3), True)), AHEAD, SIZE), AHEAD, 3, elsewhere=every)
    np.testing.assert_array_equal(found.pay, of(((2, 3), True)).pay)
