"""The paper's agents: what each one's low-level agents see, which rows act, and what can be handed from run to run."""

from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.planes import start_planes
from mc_nested.errors import PresetError
from mc_nested.learn.agents import AGENT_SPECS, Agent, check_exploration
from mc_nested.learn.dqn.compiled_engine.engine import compiled_engine
from mc_nested.learn.learnt_game import imagination_of
from mc_nested.learn.preset import load_preset
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT, small_preset

NESTED, HIERARCHICAL, SINGLE = (AGENT_SPECS[name] for name in ("nested", "hierarchical", "single"))
PRESET = small_preset()
OBSERVATIONS = np.array([[7, 13, 1], [6, 12, 3]])


def test_the_nested_agents_state_ends_with_the_main_agents_action() -> None:
    agent = Agent(NESTED, [DOT, BAR], PRESET, 0)
    assert agent.low_level_states(OBSERVATIONS, np.array([1, 0])).tolist() == [[7, 13, 1, 1], [6, 12, 3, 0]]
    assert agent.low_level_rows(np.array([1]), np.array([1, 0])).tolist() == [1]
    # 15 x 15 cells, 0 to 3 blocks, 2 materials.
    assert agent.low_level.states.highest == 15 * 15 * 4 * 2


def test_the_hierarchys_low_level_agents_have_a_row_for_each_run_and_material() -> None:
    agent = Agent(HIERARCHICAL, [DOT, BAR], PRESET, 0)
    assert agent.low_level_states(OBSERVATIONS, np.array([1, 0])).tolist() == OBSERVATIONS.tolist()
    assert agent.low_level_rows(np.array([0, 1]), np.array([1, 0])).tolist() == [1, 2]
    assert agent.rows_of(1) == {"main": slice(1, 2), "low": slice(2, 4)}
    assert agent.low_level.states.rows == 4


@pytest.mark.parametrize(("sees_choice", "width", "count"), [(True, 4, 3), (False, 3, 1)])
def test_the_single_agent_sees_its_choice_only_if_its_spec_says_so(sees_choice: bool, width: int, count: int) -> None:
    agent = Agent(replace(SINGLE, sees_choice=sees_choice), [DOT], PRESET, 0)
    shown = np.array([[7, 13, 1, 2]])
    assert agent.low_level_states(shown, np.zeros(1, np.int64)).tolist() == [[7, 13, 1, 2][:width]]
    # m is 0 before the choice, 1 or 2 after it.
    assert agent.low_level.states.highest == 15 * 15 * 2 * count
    assert agent.low_level.states.actions == 8 + 2


def test_the_single_agents_chosen_material_is_its_last_column_minus_one() -> None:
    agent = Agent(SINGLE, [DOT], PRESET, 0)
    assert agent.chosen_materials(np.array([[7, 13, 1, 0], [7, 13, 1, 2]])).tolist() == [-1, 1]


def test_only_the_single_agent_has_another_view_of_the_arenas() -> None:
    env = GridVectorEnv([DOT])
    assert Agent(NESTED, [DOT], PRESET, 0).view_of(env, [DOT]) is env
    assert Agent(SINGLE, [DOT], PRESET, 0).view_of(env, [DOT]).reset()[0].tolist() == [[7, 13, 1, 0]]


def test_a_single_agent_can_not_explore_by_excursions() -> None:
    tuned = load_preset("tuned")
    check_exploration(NESTED, tuned)
    check_exploration(SINGLE, PRESET)
    with pytest.raises(PresetError, match="not for the single agent"):
        check_exploration(SINGLE, tuned)


def test_a_single_agent_can_not_practise_in_a_learnt_game() -> None:
    live = load_preset("model-based")
    for spec in (NESTED, HIERARCHICAL):
        check_exploration(spec, live)
        assert imagination_of(Agent(spec, [DOT], live, 0), [DOT], live, 0) is not None
        assert imagination_of(Agent(spec, [DOT], PRESET, 0), [DOT], PRESET, 0) is None
    with pytest.raises(PresetError, match=r"\[imagination\] is not for the single agent"):
        check_exploration(SINGLE, live)


def test_one_runs_networks_can_be_loaded_into_an_agent_of_one_or_several_runs() -> None:
    agent, alone = Agent(HIERARCHICAL, [DOT, DOT], PRESET, 0), Agent(HIERARCHICAL, [DOT], PRESET, 9)
    rows = agent.rows_of(1)
    alone.load_online({role: online[rows[role]] for role, online in agent.online().items()})
    np.testing.assert_array_equal(alone.low_level.engine.online, agent.low_level.engine.online[2:4])
    other = Agent(HIERARCHICAL, [DOT, DOT], PRESET, 5)
    other.load_online(alone.online())
    np.testing.assert_array_equal(other.low_level.engine.online, np.tile(agent.low_level.engine.online[2:4], (2, 1)))


def test_last_figures_are_nan_before_an_update_and_then_means_over_a_runs_learners() -> None:
    agent = Agent(HIERARCHICAL, [DOT, DOT], PRESET, 0)
    assert all(np.isnan(values).all() for values in agent.last_figures().values())
    compiled_engine(agent.low_level.engine).last.values[1] = 3.0
    assert agent.last_figures()["q/low"].tolist() == pytest.approx([3.0, np.nan], nan_ok=True)
    compiled_engine(agent.low_level.engine).last.values[0] = 5.0
    assert agent.last_figures()["q/low"].tolist() == pytest.approx([4.0, np.nan], nan_ok=True)


def test_a_main_agent_remembers_which_of_300_materials_it_chose() -> None:
    many = replace(DOT, materials=tuple(replace(DOT.materials[0], name=f"m{number}") for number in range(300)))
    main = Agent(NESTED, [many], PRESET, 0).main
    assert main is not None
    start = np.array([many.start_state])
    main.store(np.array([0]), start, np.array([290]), np.ones(1), start, np.array([True]))
    assert main.replay.added_since(None)["actions"].tolist() == [290]


IMAGE = load_preset("image")
PLANES = start_planes([DOT, DOT])


def test_the_nested_agents_image_has_an_extra_plane_for_the_main_agents_action() -> None:
    agent = Agent(NESTED, [DOT, DOT], IMAGE, 0)
    assert agent.start_states([DOT, DOT]).tolist() == PLANES.tolist()
    states = agent.low_level_states(PLANES, np.array([0, 1]))
    assert states.shape == (2, 5, 15, 15)
    np.testing.assert_array_equal(states[:, :4], PLANES)
    assert [np.unique(plane).tolist() for plane in states[:, 4]] == [[128], [255]], "a_M + 1 of two materials"
    assert agent.low_level.states.shape == (5, 15, 15)


def test_the_hierarchys_agents_see_an_image_without_a_material() -> None:
    agent = Agent(HIERARCHICAL, [DOT, DOT], IMAGE, 0)
    np.testing.assert_array_equal(agent.low_level_states(PLANES, np.array([0, 1])), PLANES)
    assert (agent.low_level.states.shape, agent.low_level.states.rows) == ((4, 15, 15), 4)


def test_the_single_agents_choice_is_read_from_its_last_plane() -> None:
    agent = Agent(SINGLE, [DOT], IMAGE, 0)
    env = agent.view_of(GridVectorEnv([DOT]), [DOT])
    seen = [env.reset()[0], env.step(np.array([1]))[0]]
    assert [agent.chosen_materials(each).tolist() for each in seen] == [[-1], [1]]
    assert agent.low_level_states(seen[1], np.zeros(1, np.int64)).shape == (1, 5, 15, 15)
