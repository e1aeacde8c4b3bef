"""The simulator in arrays: it does the same as R ArenaEnvs over GridGame; masks, materials and snapshots."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv
from sim.grid import GridVectorEnv
from tests.arena.made_parts import scenarios_with_parts
from tests.arena.simulated import arena_env

LINE, ZIGZAG, DIAMOND = (load_scenario(name) for name in ("line", "zigzag", "diamond"))


@given(seed=st.integers(0, 2**32 - 1))
def test_arrays_and_single_arenas_agree_on_everything(seed: int) -> None:
    random = np.random.default_rng(seed)
    arrays, singles = GridVectorEnv([LINE] * 4), ArenaVectorEnv([arena_env(LINE) for _ in range(4)])
    material = random.integers(0, 2, 4)
    assert (
        arrays.reset(options={"material": material})[0].tolist()
        == singles.reset(options={"material": material})[0].tolist()
    )
    for _ in range(80):
        # Mostly toward the near edge and with a block, so that some arenas run out of blocks and some out of steps.
        actions = random.choice(8, 4, p=[0.05, 0.2, 0.1, 0.1, 0.1, 0.1, 0.1, 0.25])
        ours, theirs = arrays.step(actions), singles.step(actions)
        for one, other in zip(ours[:4], theirs[:4], strict=True):
            np.testing.assert_array_equal(one, other)
        np.testing.assert_array_equal(ours[4]["_score"], theirs[4]["_score"])
        np.testing.assert_array_equal(ours[4]["score"], theirs[4]["score"])
        assert [arrays.placed(run) for run in range(4)] == [singles.placed(run) for run in range(4)]
        mask = (ours[2] | ours[3]) & (random.random(4) < 0.5)
        material = random.integers(0, 2, 4)
        options = {"reset_mask": mask, "material": material}
        np.testing.assert_array_equal(arrays.reset(options=options)[0], singles.reset(options=options)[0])


@given(scenarios_with_parts(), st.integers(0, 2**32 - 1))
def test_arrays_and_single_arenas_agree_on_everything_with_parts(scenario: Scenario, seed: int) -> None:
    random, materials = np.random.default_rng(seed), len(scenario.materials)
    scenario = dataclasses.replace(scenario, step_limit=20)
    arrays, singles = GridVectorEnv([scenario] * 3), ArenaVectorEnv([arena_env(scenario) for _ in range(3)])
    chosen = {"material": random.integers(0, materials, 3)}
    np.testing.assert_array_equal(arrays.reset(options=chosen)[0], singles.reset(options=chosen)[0])
    for step in range(40):
        if step == 7:
            kept = arrays.snapshot(), singles.snapshot()
            arrays.step(np.array([Action.BD] * 3))
            singles.step(np.array([Action.BD] * 3))
            arrays.restore(kept[0])
            singles.restore(kept[1])
        actions = np.stack((random.integers(-1, 8, 3), random.integers(0, materials, 3)), axis=1)
        ours, theirs = arrays.step(actions), singles.step(actions)
        for one, other in zip(ours[:4], theirs[:4], strict=True):
            np.testing.assert_array_equal(one, other)
        assert ours[4].keys() == theirs[4].keys()
        for name in ours[4]:
            np.testing.assert_array_equal(ours[4][name], theirs[4][name])
        options = {"reset_mask": ours[2] | ours[3], "material": random.integers(0, materials, 3)}
        np.testing.assert_array_equal(arrays.reset(options=options)[0], singles.reset(options=options)[0])


def corners(size: int) -> Scenario:
    """Return an arena of that size with a block in both far corners, and one at the near edge's row."""
    cells = frozenset({(0, size - 1), (size - 1, size - 1), (size // 2, 1)})
    return Scenario(f"corners of {size}", cells, (size // 2, size // 2), 4 * size, LINE.materials, size)


@given(st.lists(st.sampled_from([5, 9, 15, 20, 32]), min_size=1, max_size=5), st.integers(0, 2**32 - 1))
def test_arenas_of_different_sizes_each_have_their_own_edge(sizes: list[int], seed: int) -> None:
    scenarios = [corners(size) for size in sizes]
    random = np.random.default_rng(seed)
    arrays, singles = GridVectorEnv(scenarios), ArenaVectorEnv([arena_env(scenario) for scenario in scenarios])
    np.testing.assert_array_equal(arrays.reset()[0], singles.reset()[0])
    assert arrays.single_observation_space.contains(np.array([max(sizes) - 1, max(sizes) - 1, 3]))
    assert not arrays.single_observation_space.contains(np.array([max(sizes), 0, 3]))
    # A drift to one side and one end, so that every edge is met.
    side, end = random.choice([Action.L, Action.R]), random.choice([Action.F, Action.B])
    for _ in range(120):
        actions = random.choice([side, end, *Action], len(sizes), p=[0.3, 0.3, *[0.05] * 8])
        ours, theirs = arrays.step(actions), singles.step(actions)
        for one, other in zip(ours[:4], theirs[:4], strict=True):
            np.testing.assert_array_equal(one, other)
        assert [arrays.placed(run) for run in range(len(sizes))] == [singles.placed(run) for run in range(len(sizes))]
        ended = ours[2] | ours[3]
        if ended.any():
            options = {"reset_mask": ended}
            np.testing.assert_array_equal(arrays.reset(options=options)[0], singles.reset(options=options)[0])


def test_snapshots_of_15_cell_arenas_keep_the_shape_of_existing_checkpoints() -> None:
    kept = GridVectorEnv([LINE, DIAMOND]).snapshot()
    assert kept["_solid"].shape == (2 * 17 * 17,)
    assert arena_env(LINE).snapshot()["env_placed"].shape == (15, 15)


def test_each_run_can_have_its_own_scenario() -> None:
    scenarios = [LINE, ZIGZAG, DIAMOND]
    envs = GridVectorEnv(scenarios)
    observations, _ = envs.reset()
    assert observations.tolist() == [[7, 14, 11], [7, 14, 11], [7, 14, 16]]
    scores: dict[int, float] = {}
    plans = [build(scenario) for scenario in scenarios]
    for step in range(60):
        actions = np.array([plan[min(step, len(plan) - 1)] for plan in plans])
        *_, info = envs.step(actions)
        scores |= {int(run): float(info["score"][run]) for run in np.flatnonzero(info["_score"])}
    assert scores == {0: 21.0, 1: 21.0, 2: 26.0}
    assert [envs.placed(run) for run in range(3)] == [scenario.design for scenario in scenarios]


def test_a_masked_reset_leaves_the_other_arenas_alone() -> None:
    envs = GridVectorEnv([LINE] * 2)
    envs.reset()
    envs.step(np.array([Action.BD, Action.BD]))
    observations, _ = envs.reset(options={"reset_mask": np.array([True, False])})
    assert observations.tolist() == [[7, 14, 11], [7, 13, 10]]
    assert envs.placed(0) == frozenset()
    assert envs.placed(1) == {(7, 14)}


def test_a_reset_without_a_material_takes_the_best_one() -> None:
    envs = GridVectorEnv([LINE] * 2)
    envs.reset(options={"material": np.array([0, 1])})
    for action in build(LINE):
        *_, info = envs.step(np.array([action, action]))
    assert info["score"].tolist() == [6.0, 21.0]


@pytest.mark.parametrize("form", [GridVectorEnv, lambda scenarios: ArenaVectorEnv([arena_env(s) for s in scenarios])])
@pytest.mark.parametrize(
    "options",
    [{"material": np.array([0])}, {"material": np.array([0, 2])}, {"reset_mask": np.array([True])}],
    ids=["too few materials", "no such material", "too short a mask"],
)
def test_reset_options_that_do_not_fit_are_refused(form: type[GridVectorEnv], options: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="material"):
        form([LINE] * 2).reset(options=options)


@pytest.mark.parametrize("form", [GridVectorEnv, lambda scenarios: ArenaVectorEnv([arena_env(s) for s in scenarios])])
def test_an_arena_without_an_action_stands_still(form: type[GridVectorEnv]) -> None:
    envs = form([LINE] * 2)
    envs.reset()
    for _ in range(70):
        observations, rewards, terminated, truncated, info = envs.step(np.array([NO_ACTION, Action.L]))
    assert observations.tolist() == [[7, 14, 11], [0, 14, 11]]
    assert (terminated.tolist(), truncated.tolist()) == ([False, False], [False, True])
    assert not info["_score"].any()
    assert rewards.tolist() == [0.0, 0.0]


def test_restoring_a_snapshot_repeats_every_arenas_course() -> None:
    envs = GridVectorEnv([LINE, corners(20), DIAMOND])
    envs.reset()
    random = np.random.default_rng(1)
    for _ in range(20):
        envs.step(random.integers(0, 8, 3))
    kept = envs.snapshot()
    ahead = random.integers(0, 8, (40, 3))
    first = [envs.step(actions)[0].tolist() for actions in ahead]
    envs.restore(kept)
    assert [envs.step(actions)[0].tolist() for actions in ahead] == first


def test_the_last_block_on_the_last_step_terminates_and_does_not_truncate() -> None:
    tight = dataclasses.replace(LINE, step_limit=len(build(LINE)))
    envs = GridVectorEnv([tight])
    envs.reset()
    for action in build(tight):
        _, _, terminated, truncated, _ = envs.step(np.array([action]))
    assert (terminated.tolist(), truncated.tolist()) == ([True], [False])


def refused(envs: GridVectorEnv, actions: Any) -> str:
    """Return what is said of these actions, which change nothing."""
    before = envs.snapshot()
    with pytest.raises(ValueError, match="actions: ") as caught:
        envs.step(actions)
    for name, kept in envs.snapshot().items():
        np.testing.assert_array_equal(kept, before[name])
    return str(caught.value)


@pytest.mark.parametrize("action", [-2, len(Action)])
def test_a_number_that_is_not_an_action_is_refused_and_changes_nothing(action: int) -> None:
    line, flag = GridVectorEnv([LINE] * 2), GridVectorEnv([load_scenario("flag")] * 2)
    line.reset()
    flag.reset(options={"material": np.array([0, 0])})
    assert "no action" in refused(line, np.array([Action.FD, action]))
    assert "no action" in refused(flag, np.array([[Action.FD, 1], [action, 1]]))


@pytest.mark.parametrize("actions", [7, [7], [7] * 3, [[7]] * 2, [7.0, 7.0], [True, True], ["7", "7"], [[7, 0, 0]] * 2])
def test_actions_that_are_not_a_whole_number_for_each_arena_are_refused(actions: Any) -> None:
    arrays, singles = GridVectorEnv([LINE] * 2), ArenaVectorEnv([arena_env(LINE) for _ in range(2)])
    for envs in (arrays, singles):
        envs.reset()
        with pytest.raises(ValueError, match="a whole number for each of the 2 arenas"):
            envs.step(np.array(actions))
    refused(arrays, np.array(actions))


@pytest.mark.parametrize("dtype", ["i1", "<i4", ">i8", "u8"])
def test_actions_may_be_whole_numbers_of_any_type(dtype: str) -> None:
    usual, other = GridVectorEnv([LINE] * 2), GridVectorEnv([LINE] * 2)
    usual.reset()
    other.reset()
    seen, *_ = usual.step(np.array([Action.FD, Action.LD]))
    np.testing.assert_array_equal(other.step(np.array([Action.FD, Action.LD], dtype))[0], seen)
