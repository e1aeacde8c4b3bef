"""What a run has seen of its arena: what each real episode's blocks were spent on, and what was built last."""

import numpy as np

from mc_nested.learn.imagination.beliefs import Belief, believe
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.known_arena import KnownArena, Spent, known_arena

AHEAD = (0, 1)


def episode(experience: Experience, *blocks: tuple[int, int, int]) -> None:
    """Add an episode whose blocks land one cell ahead of x, y, and are paid so."""
    experience.begin()
    for left, (x, y, paid) in zip(range(len(blocks), 0, -1), blocks, strict=True):
        experience.add(RealStep(x, y, left, 0, x, y, left - 1, paid, 0))
    experience.end(0, 0.0)


def seen_in(experience: Experience, blocks: int) -> KnownArena:
    return known_arena(experience, AHEAD, believe(experience.steps, AHEAD, 5, blocks))


def test_a_new_cell_is_new_once_and_then_built_or_wasted() -> None:
    experience = Experience()
    episode(experience, (1, 1, 1), (3, 3, 0))
    episode(experience, (1, 1, 1), (3, 3, 0), (2, 1, 1))
    episode(experience, (1, 1, 1), (2, 1, 1))
    seen = seen_in(experience, 2)
    assert seen.spent == (Spent(1, 2, 1, 0, 0), Spent(2, 1, 1, 1, 1), Spent(3, 0, 0, 2, 0))
    assert [spent.probes for spent in seen.spent] == [True, True, False]
    assert seen.built_last == {(1, 2), (2, 2)}
    assert (seen.known_to_pay, seen.explores) == (2, False)
    assert seen.cells[1, 2] == seen.cells[2, 2] == Belief.PAYS
    assert seen.cells[3, 4] == Belief.PAYS_NOT


def test_a_step_that_used_no_block_built_nothing() -> None:
    experience = Experience()
    experience.begin()
    experience.add(RealStep(1, 1, 3, 0, 1, 2, 3, 0, 0))
    seen = seen_in(experience, 3)
    assert seen.built_last == frozenset()
    assert seen.spent == (Spent(1, 0, 0, 0, 0),)


def test_before_the_first_episode_nothing_is_known() -> None:
    seen = seen_in(Experience(), 3)
    assert (seen.spent, seen.built_last, seen.known_to_pay, seen.explores) == ((), frozenset(), 0, True)
    assert np.all(seen.cells == Belief.UNKNOWN)


def test_the_numbers_go_on_where_old_episodes_are_forgotten() -> None:
    experience = Experience()
    for _ in range(103):
        episode(experience, (1, 1, 1))
    assert [spent.episode for spent in seen_in(experience, 1).spent] == list(range(4, 104))


def test_what_another_run_brought_is_known_and_is_no_episode_of_this_one() -> None:
    earlier, experience = Experience(), Experience()
    episode(earlier, (1, 1, 1), (3, 3, 0))
    experience.begin_from(earlier.state(), pays=True, materials=True)
    assert seen_in(experience, 1).known_to_pay == 1
    assert seen_in(experience, 1).spent == ()
    episode(experience, (1, 1, 1), (2, 1, 1))
    assert seen_in(experience, 2).spent == (Spent(1, 1, 1, 1, 0),)
    assert seen_in(experience, 2).built_last == {(1, 2), (2, 2)}


def test_of_another_design_no_cell_is_known_and_every_cell_is_new() -> None:
    earlier, experience = Experience(), Experience()
    episode(earlier, (1, 1, 1), (3, 3, 0))
    experience.begin_from(earlier.state(), pays=False, materials=False)
    assert len(experience.steps) == 2
    assert len(experience.extras) == 0
    seen = seen_in(experience, 2)
    assert not np.isin(seen.cells, (Belief.PAYS, Belief.PAYS_NOT)).any()
    episode(experience, (1, 1, 0))
    assert seen_in(experience, 2).spent == (Spent(1, 1, 0, 0, 0),)
