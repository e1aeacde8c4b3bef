"""What a person did, as actions: by the rules, whatever cells and blocks the screen showed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import front_of, is_inside, landing, moved
from mc_nested.errors import LiveError
from mc_nested.live.model.person_moves import new_block, outcomes_of, placed_from

SIZE = 5
cells = st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1))


@given(st.lists(cells, min_size=1, max_size=4), st.booleans())
def test_a_walk_and_its_block_are_told_as_the_rules_would_have_it(walk: list[Cell], places: bool) -> None:
    front = front_of(walk[-1])
    block = front if places and is_inside(front, SIZE) else None
    cell, placed = walk[0], set[Cell]()
    for outcome in outcomes_of(walk, block, {}, SIZE):
        assert outcome.instead is not None
        cell = moved(cell, outcome.instead, placed, SIZE)
        assert outcome == Outcome(cell, landing(cell, outcome.instead, placed, SIZE), outcome.instead)
        placed |= {outcome.placed} if outcome.placed else set()
    assert (cell, placed) == (walk[-1], {block} if block else set())


def test_who_stays_where_they_are_did_nothing() -> None:
    assert outcomes_of([(2, 2)], None, {}, SIZE) == []


def test_a_walk_leads_around_a_block() -> None:
    way = [outcome.instead for outcome in outcomes_of([(2, 1), (2, 3)], None, {(2, 2)}, SIZE)]
    assert sorted(each for each in way if each is not None) == [Action.F, Action.F, Action.L, Action.R]


def test_a_person_on_top_of_a_block_is_one_clear_line() -> None:
    with pytest.raises(LiveError, match=r"you are at \(2, 2\), where nobody can walk from \(2, 1\): stay on the floor"):
        outcomes_of([(2, 1), (2, 2)], None, {(2, 2)}, SIZE)


def test_a_block_is_placed_from_the_last_cell_of_a_walk_that_it_lies_in_front_of() -> None:
    assert placed_from([(1, 1), (2, 1), (1, 1), (1, 0)], (1, 2)) == 2
    with pytest.raises(LiveError, match=r"a block was placed at \(4, 4\), not in front of you at \(1, 0\)"):
        placed_from([(1, 1), (1, 0)], (4, 4))


BUILT = {(2, 2): "minecraft:stone"}


@pytest.mark.parametrize(
    ("cell", "level", "name", "seen"),
    [
        ((1, 1), 0, "minecraft:stone", (1, 1)),
        ((2, 2), 0, "minecraft:stone", None),
        ((1, 1), -1, "minecraft:obsidian", None),
        ((1, 1), 3, "minecraft:glass", None),
        ((1, SIZE), 0, "minecraft:lapis_block", None),
        ((-1, 0), -2, "minecraft:dirt", None),
    ],
)
def test_a_block_that_is_looked_at_is_new_or_known(cell: Cell, level: int, name: str, seen: Cell | None) -> None:
    assert new_block(cell, level, name, BUILT, "minecraft:stone", SIZE) == seen


@pytest.mark.parametrize(
    ("cell", "level", "name", "complaint"),
    [
        ((2, 2), -1, "minecraft:obsidian", r"the block at \(2, 2\) was broken"),
        ((1, 1), -2, "minecraft:dirt", r"the floor at \(1, 1\) was broken"),
        ((2, 2), 1, "minecraft:stone", r"a block stands at \(2, 2\) above the ground"),
        ((1, 1), 0, "minecraft:dirt", r"dirt was placed at \(1, 1\), not minecraft:stone"),
        ((2, 2), 0, "minecraft:dirt", r"dirt was placed at \(2, 2\), not minecraft:stone"),
    ],
)
def test_what_no_action_does_is_one_clear_line(cell: Cell, level: int, name: str, complaint: str) -> None:
    with pytest.raises(LiveError, match=complaint):
        new_block(cell, level, name, BUILT, "minecraft:stone", SIZE)
