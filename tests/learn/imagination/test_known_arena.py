"""A run's knowledge of its arena: where the blocks of each real episode went, and which cells were built last."""

import numpy as np

from mc_nested.learn.imagination.beliefs import Belief, believe, evidence_of
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.known_arena import EpisodeBlocks, KnownArena, known_arena

AHEAD = (0, 1)


def episode(experience: Experience, *blocks: tuple[int, int, int]) -> None:
    """Add an episode whose blocks, each (x, y, paid), land one cell ahead of x, y."""
    experience.begin()
    for left, (x, y, paid) in zip(range(len(blocks), 0, -1), blocks, strict=True):
        experience.add(RealStep(x, y, left, 0, x, y, left - 1, paid, 0))
    experience.end(0, 0.0)


def known_in(experience: Experience, blocks: int) -> KnownArena:
    return known_arena(experience, AHEAD, believe(evidence_of(experience.steps, AHEAD, 5), AHEAD, blocks))


def test_a_cell_counts_as_new_once_and_then_as_built_or_wasted() -> None:
    experience = Experience()
    episode(experience, (1, 1, 1), (3, 3, 0))
    episode(experience, (1, 1, 1), (3, 3, 0), (2, 1, 1))
    episode(experience, (1, 1, 1), (2, 1, 1))
    known = known_in(experience, 2)
    assert known.episodes == (EpisodeBlocks(1, 2, 1, 0, 0), EpisodeBlocks(2, 1, 1, 1, 1), EpisodeBlocks(3, 0, 0, 2, 0))
    assert [blocks.probes for blocks in known.episodes] == [True, True, False]
    assert known.built_last == {(1, 2), (2, 2)}
    assert (known.known_to_pay, known.explores) == (2, False)
    assert known.cells[1, 2] == known.cells[2, 2] == Belief.PAYS
    assert known.cells[3, 4] == Belief.PAYS_NOT


def test_a_step_that_used_no_block_built_nothing() -> None:
    experience = Experience()
    experience.begin()
    experience.add(RealStep(1, 1, 3, 0, 1, 2, 3, 0, 0))
    known = known_in(experience, 3)
    assert known.built_last == frozenset()
    assert known.episodes == (EpisodeBlocks(1, 0, 0, 0, 0),)


def test_before_the_first_episode_nothing_is_known() -> None:
    known = known_in(Experience(), 3)
    assert (known.episodes, known.built_last, known.known_to_pay, known.explores) == ((), frozenset(), 0, True)
    assert np.all(known.cells == Belief.UNKNOWN)


def test_episode_numbers_continue_after_old_episodes_are_forgotten() -> None:
    experience = Experience()
    for _ in range(103):
        episode(experience, (1, 1, 1))
    assert [blocks.episode for blocks in known_in(experience, 1).episodes] == list(range(4, 104))


def test_cells_of_an_earlier_run_are_known_but_its_episodes_are_not_counted() -> None:
    earlier, experience = Experience(), Experience()
    episode(earlier, (1, 1, 1), (3, 3, 0))
    experience.begin_from(earlier.state(), pays=True, materials=True)
    assert known_in(experience, 1).known_to_pay == 1
    assert known_in(experience, 1).episodes == ()
    episode(experience, (1, 1, 1), (2, 1, 1))
    assert known_in(experience, 2).episodes == (EpisodeBlocks(1, 1, 1, 1, 0),)
    assert known_in(experience, 2).built_last == {(1, 2), (2, 2)}


def test_an_earlier_run_on_another_design_leaves_every_cell_unknown_and_new() -> None:
    earlier, experience = Experience(), Experience()
    episode(earlier, (1, 1, 1), (3, 3, 0))
    experience.begin_from(earlier.state(), pays=False, materials=False)
    assert len(experience.steps) == 2
    assert len(experience.extras) == 0
    known = known_in(experience, 2)
    assert not np.isin(known.cells, (Belief.PAYS, Belief.PAYS_NOT)).any()
    episode(experience, (1, 1, 0))
    assert known_in(experience, 2).episodes == (EpisodeBlocks(1, 1, 0, 0, 0),)
