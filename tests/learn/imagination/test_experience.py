"""A run's memory of its game: transitions by episode, scores that materials brought, and recent episodes alone."""

import numpy as np
import pytest

from mc_nested.learn.imagination.experience import RECENT, Experience, RealStep

STEP = RealStep(2, 1, 3, 4, 2, 2, 2, 1, 0)


def episode_of(seen: Experience, steps: int, material: int = 0, score: float = 0.0) -> None:
    seen.begin()
    for step in range(steps):
        seen.add(STEP._replace(x=step))
    seen.end(material, score)


def test_a_new_experience_is_empty() -> None:
    seen = Experience()
    assert (seen.episodes, seen.steps.shape, seen.first_of_episode.shape) == (0, (0, 9), (0,))
    assert seen.extras.shape == (0, 3)


def test_steps_of_episodes_are_stored_one_after_the_other() -> None:
    seen = Experience()
    for steps in (2, 1, 3):
        episode_of(seen, steps)
    assert seen.steps[:, 0].tolist() == [0, 1, 0, 0, 1, 2]
    assert seen.steps[3].tolist() == list(STEP._replace(x=0))
    assert seen.first_of_episode.tolist() == [0, 2, 3]
    assert seen.episodes == 3


def test_a_materials_extra_is_the_score_beyond_the_blocks_paid_in_its_episode() -> None:
    seen = Experience()
    episode_of(seen, 2, material=1, score=12.0)  # two blocks that paid, and p = 10
    episode_of(seen, 3, material=0, score=-2.0)  # three, and p = -5
    assert seen.extras.tolist() == [[1.0, 10.0, 2.0], [0.0, -5.0, 3.0]]


def test_old_episodes_are_forgotten() -> None:
    seen = Experience()
    for episode in range(RECENT + 7):
        episode_of(seen, 1 + episode % 3, score=float(episode))
    lengths = [1 + episode % 3 for episode in range(7, RECENT + 7)]
    assert seen.first_of_episode.tolist() == [0, *np.cumsum(lengths)[:-1].tolist()]
    assert len(seen.steps) == sum(lengths)
    assert seen.steps[seen.first_of_episode, 0].tolist() == [0] * RECENT
    assert seen.episodes == RECENT + 7, "its number stays that of the run"
    assert len(seen.extras) <= RECENT + 1


@pytest.mark.parametrize("steps", [0, 2])
def test_a_loaded_experience_continues_as_the_saved_one(steps: int) -> None:
    seen, again = Experience(), Experience()
    episode_of(seen, 3, score=4.0)
    seen.begin()
    for _ in range(steps):
        seen.add(STEP)
    again.load({name: kept.copy() for name, kept in seen.state().items()})
    for each in (seen, again):
        each.add(STEP)
        each.end(1, 7.0)
        episode_of(each, 1)
    assert again.episodes == seen.episodes == 3
    assert again.steps.dtype == seen.steps.dtype == np.int64
    for name, kept in seen.state().items():
        np.testing.assert_array_equal(again.state()[name], kept, err_msg=name)


def test_a_saved_experience_is_a_copy() -> None:
    seen = Experience()
    episode_of(seen, 2)
    kept = seen.state()
    episode_of(seen, 5)
    assert (len(kept["steps"]), int(kept["episodes"])) == (2, 1)


def test_an_experience_with_wrong_or_missing_arrays_is_refused() -> None:
    with pytest.raises((TypeError, ValueError)):
        Experience().load({**Experience().state(), "steps": np.zeros((2, 5), np.int64)})
    with pytest.raises(KeyError):
        Experience().load({})
