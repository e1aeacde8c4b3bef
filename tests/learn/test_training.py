"""A training's journal: what was added since a mark, and nothing twice."""

import numpy as np

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.training import Training
from tests.learn.made_experiments import DOT, small_preset

PLAYED = [EpisodeRow(0, episode, 3.0, 1, 9, 0.5, 0.25) for episode in (1, 2, 3)]
GREEDY = EvaluationRow(0, 2, 4.0, 1, 7)


def training() -> Training:
    preset = small_preset()
    return Training([DOT], Agent(AGENT_SPECS["nested"], [DOT], preset, 0), preset, 0)


def store(into: Training, *blocks: int) -> None:
    """Store a transition for each of these numbers of blocks."""
    for left in blocks:
        state = np.array([[7, 13, left, 0]])
        into.agent.low_level.store(np.array([0]), state, np.array([3]), np.ones(1), state, np.zeros(1, np.bool_))


def test_journals_saved_in_parts_restore_the_whole_training() -> None:
    whole, again = training(), training()
    whole.episode_rows.append(PLAYED[0])
    store(whole, 1, 0)
    parts, marks = [whole.journal(None)], whole.marks()
    whole.episode_rows += PLAYED[1:]
    whole.evaluation_rows.append(GREEDY)
    store(whole, 1)
    parts.append(whole.journal(marks))
    assert len(parts[1]["rows.episodes"]) == 2, "what was there at the marks isn't written again"
    again.load(whole.state(), parts)
    assert (again.episode_rows, again.evaluation_rows) == (PLAYED, [GREEDY])
    assert again.agent.low_level.replay.added.tolist() == [3]
    for name, rows in whole.journal(None).items():
        np.testing.assert_array_equal(again.journal(None)[name], rows, err_msg=name)
