"""Greedy play of a team: it repeats the last evaluation of the training that it comes from."""

import numpy as np
import pytest

from mc_nested.learn.cooperation.team_agent import KINDS, Kind, TeamAgent
from mc_nested.learn.cooperation.team_evaluation import play_team_greedily
from tests.learn.cooperation.teams import SHORT, arena_of, finish, trainer_of


@pytest.mark.parametrize("kind", KINDS)
def test_a_greedy_episode_is_the_trainings_last_evaluation(kind: Kind) -> None:
    trainer = finish(trainer_of(kind, 2))
    for last in [row for row in trainer.evaluation_rows if row.episode == SHORT.episodes]:
        rows = trainer.agent.rows_of(last.trial)
        agent = TeamAgent(kind, trainer.agent.team, SHORT, 0, [last.trial])
        agent.load_online({role: trainer.kept[role][rows[role]] for role in agent.online()})
        episode = play_team_greedily(arena_of(kind, agent.team), agent)
        assert (episode.material, episode.ticks, episode.score) == (last.material, last.steps, last.score)
        assert trainer.kept_scores[last.trial] == last.score


def test_networks_of_another_shape_are_refused() -> None:
    agent = trainer_of("shared", 2).agent
    with pytest.raises(ValueError, match="networks of"):
        agent.load_online({role: np.zeros((1, 3), np.float32) for role in agent.online()})
