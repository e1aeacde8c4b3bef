"""The tally, through the Env: what a step of a scenario with parts brings, worked by hand."""

from dataclasses import replace

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build, build_with_materials
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Material, Part, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv
from sim.grid import GridVectorEnv
from tests.arena.made_parts import STONE, STRIPES, TO_FAR, TO_NEAR, WOOD, scenarios_with_parts
from tests.arena.simulated import arena_env

LINE = load_scenario("line")


def begun(scenario: Scenario, material: str = "stone") -> ArenaEnv:
    env = arena_env(scenario)
    env.reset(options={"material": material})
    return env


def test_an_env_with_parts_takes_an_action_and_a_material() -> None:
    env = arena_env(STRIPES)
    assert env.action_space.contains(np.array([7, 1]))
    assert not env.action_space.contains(np.array([7, 2]))
    check_env(env, skip_render_check=True)


def test_a_block_pays_on_the_current_part_and_not_on_a_later_one() -> None:
    env = begun(STRIPES)
    assert env.step((Action.BD, STONE))[1] == 0.0
    assert env.step((Action.RD, STONE))[1] == 0.0
    assert env.placed == {(1, 1), (2, 1)}, "beside the design, and the far stripe is over with them"
    other = begun(STRIPES)
    assert other.step((Action.RD, STONE))[1] == 0.0, "a cell of the near stripe, while the far one is built"
    assert other.placed == {(2, 2)}


def test_each_part_earns_the_worth_of_the_material_used_there() -> None:
    env = begun(STRIPES)
    far = [env.step((action, STONE)) for action in TO_FAR]
    assert [step[1] for step in far] == [1.0, 1.0]
    assert [step[4]["earned"] for step in far] == [1 + 5, 2 + 10]
    near = [env.step((action, WOOD)) for action in TO_NEAR]
    assert [step[1] for step in near] == [0.0, 1.0, 0.0, 1.0, 1.0]
    assert [step[4]["earned"] for step in near] == [12, 12 + 3, 15, 12 + 6, 12 + 9]
    assert near[-1][4]["score"] == STRIPES.optimum
    assert near[-1][2:4] == (True, False)
    assert not any("score" in step[4] for step in [*far, *near[:-1]])


def test_the_main_agent_chooses_when_a_part_is_used_up_but_not_at_the_episodes_end() -> None:
    env = begun(STRIPES)
    chooses = [env.step((action, STONE))[4]["chooses"] for action in (*TO_FAR, *TO_NEAR)]
    assert chooses == [False, True, False, False, False, False, False]


def test_choose_every_lets_the_main_agent_choose_that_many_steps_after_its_last_choice() -> None:
    env = begun(replace(STRIPES, choose_every=3))
    actions = (Action.B, Action.F, *TO_FAR, *TO_NEAR)
    # After 3 steps, at the far stripe's end, and 3 steps later.
    chooses = [env.step((action, STONE))[4]["chooses"] for action in actions]
    assert chooses == [False, False, True, True, False, False, True, False, False]


def test_blocks_of_two_materials_share_their_parts_p() -> None:
    env = begun(STRIPES, "wood")
    env.step((TO_FAR[0], WOOD))
    assert env.step((TO_FAR[1], STONE))[4]["earned"] == 2 + (-5 + 10) / 2


def test_missing_blocks_of_the_last_begun_part_count_for_the_material_in_hand() -> None:
    env = begun(STRIPES)
    env.step((TO_FAR[0], STONE))
    steps = [env.step((Action.B, WOOD)) for _ in range(11)]
    assert steps[-1][3], "truncated"
    assert steps[-2][4]["earned"] == 1 + 5
    assert steps[-1][4]["score"] == steps[-1][4]["earned"] == 1 + (10 - 5) / 2


def test_an_action_without_a_material_keeps_the_material_in_hand() -> None:
    env = begun(STRIPES, "wood")
    assert env.step(Action.FD)[4]["earned"] == 1 - 2.5
    env.step((Action.RD, STONE))
    assert env.step(Action.B)[4]["material"] == "stone"


def test_an_unknown_material_index_is_refused_and_no_step_is_done() -> None:
    env = begun(STRIPES)
    with pytest.raises(ValueError, match="an index that the scenario doesn't have"):
        env.step((Action.FD, 2))
    assert env.placed == frozenset()
    assert env.step((Action.FD, STONE))[1] == 1.0


@given(actions=st.lists(st.sampled_from(Action), min_size=60, max_size=60), material=st.sampled_from([WOOD, STONE]))
def test_a_scenario_with_one_part_and_one_choice_steps_as_without_parts(actions: list[Action], material: int) -> None:
    as_one = replace(LINE, parts=(Part(LINE.design, (-5.0, 10.0)),))
    name = LINE.materials[material].name
    one, none = begun(as_one, name), begun(LINE, name)
    for action in actions:
        ours, theirs = one.step((action, material)), none.step(action)
        assert ours[0].tolist() == theirs[0].tolist()
        assert ours[1:4] == theirs[1:4]
        assert ours[4].get("score") == theirs[4].get("score")
        assert not ours[4]["chooses"]
        if ours[2] or ours[3]:
            break


@given(scenarios_with_parts())
def test_the_builder_reaches_the_optimum_of_any_parts(scenario: Scenario) -> None:
    env = arena_env(replace(scenario, step_limit=len(build(scenario))))
    env.reset()
    *_, last = [env.step(step) for step in build_with_materials(scenario)]
    assert last[2:4] == (True, False)
    assert last[4]["score"] == scenario.optimum


@given(scenarios_with_parts(), st.integers(0, 2**32 - 1))
def test_no_episode_scores_more_than_the_optimum(scenario: Scenario, seed: int) -> None:
    random = np.random.default_rng(seed)
    env = begun(scenario)
    for _ in range(scenario.step_limit):
        *_, terminated, truncated, info = env.step((random.integers(8), random.integers(len(scenario.materials))))
        if terminated or truncated:
            assert info["score"] <= scenario.optimum + 1e-9
            break


def test_equally_worth_materials_in_one_part_add_up_to_their_worth_exactly() -> None:
    # A third and two thirds of 0.1 aren't 0.1 in binary.
    far = frozenset({(1, 3), (2, 3), (3, 3)})
    alike = replace(STRIPES, design=far, parts=(Part(far, (0.1, 0.1)),))
    env = begun(alike)
    steps = [env.step(step) for step in ((Action.FD, STONE), (Action.RD, WOOD), (Action.RD, WOOD))]
    assert steps[-1][4]["score"] == alike.optimum == 3 + 0.1


def test_an_arena_without_an_action_earns_nothing_and_offers_no_choice() -> None:
    arenas = GridVectorEnv([STRIPES, STRIPES])
    arenas.reset(options={"material": np.array([STONE, STONE])})
    _, rewards, *_, info = arenas.step(np.array([[NO_ACTION, WOOD], [Action.FD, STONE]]))
    assert rewards.tolist() == [0.0, 1.0]
    assert info["earned"].tolist() == [0.0, 6.0]
    assert info["_chooses"].tolist() == [False, True]
    assert arenas.step(np.array([[Action.FD, STONE], [NO_ACTION, 0]]))[4]["earned"].tolist() == [6.0, 0.0]


def test_arenas_with_and_without_parts_are_scored_side_by_side() -> None:
    arenas = GridVectorEnv([STRIPES, replace(STRIPES, parts=())])
    arenas.reset(options={"material": np.array([STONE, STONE])})
    for action in (*TO_FAR, *TO_NEAR):
        *_, info = arenas.step(np.array([[action, STONE]] * 2))
    assert info["score"].tolist() == [5 + 10 - 3, 5 + 10]


def test_a_part_that_would_begin_at_truncation_earns_nothing() -> None:
    env = begun(replace(STRIPES, step_limit=2))
    (_, _, _, _, first), (_, _, _, truncated, last) = [env.step((action, STONE)) for action in TO_FAR]
    assert truncated
    assert not last["chooses"]
    assert (first["earned"], last["score"]) == (1 + 5, 2 + 10), (
        "and not what three blocks of stone would cost the second"
    )


LEFT, RIGHT = 0, 1

HALVES = replace(
    STRIPES,
    materials=(Material("left", 0.0, "stone"), Material("right", 0.0, "stone")),
    parts=(Part(STRIPES.design, (0.0, 0.0)),),
    choose_every=3,
    regions=True,
)
"""Its right half begins at x = 3: of the design, only (3, 2) lies there."""


def test_a_block_in_the_chosen_region_pays_the_nested_agent_and_one_elsewhere_the_main_agent_alone() -> None:
    env = begun(HALVES, "left")
    steps = [
        env.step(taken) for taken in ((Action.FD, LEFT), (Action.RD, RIGHT), (Action.BD, RIGHT), (Action.RD, RIGHT))
    ]
    assert env.placed == {(1, 3), (2, 3), (2, 2), (3, 2)}
    assert [step[1] for step in steps] == [1.0, 0.0, 0.0, 1.0]
    assert [step[4]["earned"] for step in steps] == [1.0, 2.0, 3.0, 4.0]


def test_a_block_beside_the_design_pays_nobody_in_its_region() -> None:
    env = begun(HALVES, "left")
    _, reward, *_, info = env.step((Action.LD, LEFT))
    assert env.placed == {(0, 2)}
    assert (reward, info["earned"]) == (0.0, 0.0)


def test_the_main_agent_chooses_a_region_after_each_block_and_after_some_steps_without_one() -> None:
    env = begun(HALVES, "left")
    actions = (Action.B, Action.FD, Action.L, Action.R, Action.B, Action.F)
    assert [env.step((action, LEFT))[4]["chooses"] for action in actions] == [False, True, False, False, True, False]


def test_the_single_agent_takes_a_region_in_hand_by_an_action_and_is_paid_wherever_a_block_is_on_the_design() -> None:
    env = SingleAgentVectorEnv(GridVectorEnv([HALVES]), [HALVES])
    env.reset()
    steps = [env.step(np.array([action])) for action in (LEFT, 2 + Action.FD, RIGHT, 2 + Action.BD)]
    assert [int(step[0][0, -1]) for step in steps] == [LEFT + 1, LEFT + 1, RIGHT + 1, RIGHT + 1]
    assert [float(step[1][0]) for step in steps] == [0.0, 1.0, 0.0, 1.0], "(1, 2) is in the left half"


def test_arenas_without_parts_ignore_a_material_beside_an_action() -> None:
    for env in (GridVectorEnv([LINE]), ArenaVectorEnv([arena_env(LINE)])):
        env.reset()
        observations, *_ = env.step(np.array([[Action.B, STONE]]))
        assert observations.tolist() == [[7, 13, 11]]
