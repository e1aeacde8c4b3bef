"""What is learnt from a whole episode is what its steps were."""

import numpy as np
import pytest

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.lesson import learn_episode, materials_of
from mc_nested.learn.main_choices import MainChoices
from mc_nested.learn.preset import load_preset
from tests.learn.games.lockstep import game_of, learner_of
from tests.learn.imagination.made_games import BENT

PAPER = load_preset("paper")
GAMMA = PAPER.update.gamma


@pytest.mark.parametrize("name", ["nested", "hierarchical", "single"])
@pytest.mark.parametrize("seed", range(5))
def test_every_step_is_a_transition_of_the_agent_that_acted_and_the_choice_is_one_of_the_main_agent(
    name: str, seed: int
) -> None:
    plan = learner_of(BENT, PAPER, agent=name, seed=seed).plan("game")
    played = game_of(BENT, PAPER, name)(plan)
    agent = Agent(AGENT_SPECS[name], [BENT], PAPER, 0)
    start = agent.start_states([BENT])
    choices = MainChoices(agent.main, [BENT], start, PAPER, 0, [0]) if agent.main else None
    materials = materials_of(agent, played, plan.material)
    learn_episode(agent, choices, PAPER, played, materials, played.steps, np.random.default_rng(0))

    replay, states = agent.low_level.replay, agent.low_level.states
    row = plan.material if name == "hierarchical" else 0
    assert replay.added.tolist() == [played.steps if at == row else 0 for at in range(states.rows)]
    held = replay.gather(np.array([row]), np.arange(played.steps)[None])
    seen = states.kept(agent.low_level_states(played.observations, materials))
    np.testing.assert_array_equal(held.states[:, 0], [seen[:-1], seen[1:]])
    np.testing.assert_array_equal(held.actions[0], played.actions)
    np.testing.assert_array_equal(held.rewards[0], played.rewards)
    discounts = np.full(played.steps, GAMMA, np.float32)
    discounts[-1] *= not played.terminated
    np.testing.assert_array_equal(held.discounts[0], discounts)
    if agent.main:
        chosen = agent.main.replay.gather(np.array([0]), np.array([[0]]))
        assert agent.main.replay.added.tolist() == [1]
        assert chosen.actions.tolist() == [[plan.material]]
        assert chosen.rewards.tolist() == [[played.score]]
        assert chosen.discounts.tolist() == [[0.0]]


def test_a_single_agents_material_is_what_its_actions_chose() -> None:
    played = game_of(BENT, PAPER, "single")(learner_of(BENT, PAPER, agent="single", seed=1).plan("game"))
    materials = materials_of(Agent(AGENT_SPECS["single"], [BENT], PAPER, 0), played, 0)
    assert materials[0] == -1
    assert materials.tolist() == (played.observations[:, -1] - 1).tolist()
