"""A team's agents: what each sees, which row plays whom, and what is shared."""

import numpy as np
import pytest

from mc_nested.arena.cooperative.team import team_of
from mc_nested.errors import PresetError
from mc_nested.learn.cooperation.team_agent import KINDS, Kind, TeamAgent
from mc_nested.learn.preset import load_preset
from tests.learn.cooperation.teams import LINE, PAPER


def agent_of(kind: Kind, builders: int, runs: int = 2) -> TeamAgent:
    return TeamAgent(kind, team_of(LINE, builders), PAPER, 0, range(runs))


SEEN = np.array([[[7, 14, 11], [3, 2, 11]], [[0, 0, 4], [1, 1, 4]]])


@pytest.mark.parametrize("kind", ["shared", "own"])
def test_a_nested_agents_state_is_its_cell_the_blocks_its_number_and_the_main_action(kind: Kind) -> None:
    states = agent_of(kind, 2).states(SEEN, np.array([1, 0]))
    assert states.tolist() == [[[7, 14, 11, 0, 1], [3, 2, 11, 1, 1]], [[0, 0, 4, 0, 0], [1, 1, 4, 1, 0]]]


def test_a_builder_alone_has_no_number() -> None:
    assert agent_of("shared", 1).states(SEEN[:, :1], np.array([1, 0])).tolist() == [[[7, 14, 11, 1]], [[0, 0, 4, 0]]]


def test_a_single_agent_sees_what_its_arena_shows() -> None:
    seen = np.concatenate((SEEN, np.ones((2, 2, 1), np.int64)), axis=2)
    assert agent_of("single", 2).states(seen, np.array([1, 0])).tolist() == seen.tolist()


def test_builders_share_a_row_or_have_their_own() -> None:
    runs = np.array([0, 1])
    assert [agent_of("shared", 3).rows(runs, builder).tolist() for builder in range(3)] == [[0, 1]] * 3
    assert [agent_of("own", 3).rows(runs, builder).tolist() for builder in range(3)] == [[0, 3], [1, 4], [2, 5]]


# 4 inputs alone and 5 with a number; 8 or 10 actions; hidden layers of 32; the main agent has 3 inputs and 2 actions.
MAIN = 4 * 32 + 33 * 32 + 33 * 2
ALONE, NUMBERED, SINGLE = (5 * 32 + 33 * 32 + 33 * 8), (6 * 32 + 33 * 32 + 33 * 8), (5 * 32 + 33 * 32 + 33 * 10)


@pytest.mark.parametrize(
    ("kind", "builders", "networks", "parameters"),
    [
        ("shared", 1, 2, MAIN + ALONE),
        ("shared", 4, 2, MAIN + NUMBERED),
        ("own", 4, 5, MAIN + 4 * NUMBERED),
        ("single", 4, 4, 4 * SINGLE),
    ],
)
def test_networks_and_parameters(kind: Kind, builders: int, networks: int, parameters: int) -> None:
    agent = agent_of(kind, builders)
    assert (agent.networks, agent.parameters) == (networks, parameters)


def store_a_tick(agent: TeamAgent) -> None:
    states = agent.states(SEEN, np.array([1, 0]))
    agent.store(np.array([0, 1]), states, np.zeros((2, 2), np.int64), np.ones((2, 2)), states, np.zeros(2, np.bool_))


def test_what_is_shared_learns_from_all_and_what_is_own_from_its_own() -> None:
    shared, own = agent_of("shared", 2), agent_of("own", 2)
    store_a_tick(shared)
    store_a_tick(own)
    assert shared.builders.replay.added.tolist() == [2, 2]
    assert own.builders.replay.added.tolist() == [1, 1, 1, 1]


def test_each_builder_has_an_update_a_tick() -> None:
    shared, own = agent_of("shared", 2), agent_of("own", 2)
    for agent in (shared, own):
        for _ in range(32):
            store_a_tick(agent)
        agent.learn(np.array([0, 1]), np.random.default_rng(0).random((2, 2, 1, 32)))
    assert shared.builders.engine.updates.tolist() == [2, 2]
    assert own.builders.engine.updates.tolist() == [1, 1, 1, 1]


@pytest.mark.parametrize(("preset", "table"), [("tuned", "excursions"), ("live", "imagination")])
@pytest.mark.parametrize("kind", KINDS)
def test_ways_to_explore_that_are_for_one_builder_are_refused(kind: Kind, preset: str, table: str) -> None:
    with pytest.raises(PresetError, match=rf"^\[{table}\] is for a builder alone: take the preset paper"):
        TeamAgent(kind, team_of(LINE, 2), load_preset(preset), 0, [0])


def test_images_are_refused() -> None:
    with pytest.raises(PresetError, match=r"^builders in one arena see numbers, not states 'image': take the preset"):
        TeamAgent("shared", team_of(LINE, 2), load_preset("image"), 0, [0])
