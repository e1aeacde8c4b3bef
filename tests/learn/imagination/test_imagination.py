"""Each run learns and practises from its own steps, and each material's agent of a hierarchy from its own."""

import dataclasses
from collections.abc import Sequence

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent, AgentSpec
from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.first_tries import FIRST_TRIES
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.learnt_game import imagination_of as learnt_games_of
from mc_nested.learn.preset import Preset
from sim.grid import GridGame
from tests.learn.imagination.made_games import BENT, SMALL, TRUE_MOVES, TRUE_PLACES, TWO, assert_rules
from tests.learn.made_trainings import copied

NESTED, HIERARCHICAL = AGENT_SPECS["nested"], AGENT_SPECS["hierarchical"]
BUILT = [Action.FD, Action.R, Action.FD]
"""The last one is stopped at the edge, or not: its block lands ahead."""


def imagination_of(
    runs: int = 1, spec: AgentSpec = NESTED, preset: Preset = SMALL, seed: int = 0, numbers: Sequence[int] | None = None
) -> tuple[Agent, Imagination]:
    agent = Agent(spec, [BENT] * runs, preset, seed, numbers)
    made = learnt_games_of(agent, [BENT] * runs, preset, seed)
    assert made is not None
    return agent, made


def play(imagination: Imagination, actions: Sequence[int], run: int = 0, runs: int = 1, material: int = 1) -> None:
    """Play an episode of these actions in one of the runs, by the real rules; the others stand still."""
    env, rows = ArenaEnv(GridGame(BENT), BENT), np.array([run])
    materials = np.full(runs, material)
    before = np.tile(env.reset(options={"material": BENT.materials[material].name})[0], (runs, 1))
    imagination.begin(rows)
    score = 0.0
    for action in actions:
        after, reward, terminated, _, info = env.step(action)
        every = np.tile(after, (runs, 1))
        done = np.full(runs, action)
        imagination.observe(rows, before, materials, done, np.full(runs, reward), every)
        before, score = every, info.get("score", score)
        if terminated:
            break
    imagination.end(rows, materials, np.full(runs, score))


def at_random(imagination: Imagination, episodes: int, run: int = 0, runs: int = 1, seed: int = 0) -> None:
    random = np.random.default_rng(seed)
    for episode in range(episodes):
        play(imagination, random.integers(0, 8, BENT.step_limit).tolist(), run, runs, episode % 2)


def test_a_run_learns_the_rules_and_the_design_from_its_own_steps_alone() -> None:
    _, imagination = imagination_of(2)
    at_random(imagination, 30, run=1, runs=2)
    assert_rules(imagination.rules(1), TRUE_MOVES, TRUE_PLACES, (0, 1))
    assert not imagination.rules(0).known.any()
    assert (imagination.beliefs(0).cells == Belief.UNKNOWN).all()
    paying = {(int(x), int(y)) for x, y in np.argwhere(imagination.beliefs(1).cells == Belief.PAYS)}
    assert paying
    assert paying <= BENT.design


def test_nothing_is_practised_before_the_first_step() -> None:
    agent, imagination = imagination_of()
    before = agent.low_level.engine.online.copy()
    assert not imagination.practise(0, 1)
    np.testing.assert_array_equal(agent.low_level.engine.online, before)


def test_practice_of_a_known_design_ends_with_a_policy_that_reaches_the_optimum() -> None:
    agent, imagination = imagination_of()
    at_random(imagination, 10)
    play(imagination, [Action.FD, Action.RD, Action.F, Action.L, Action.B, Action.FD, Action.FD])
    while imagination.beliefs(0).explores:
        at_random(imagination, 10, seed=1)
    assert imagination.practise(0, 1)
    env = ArenaEnv(GridGame(BENT), BENT)
    observation, _ = env.reset(options={"material": "stone"})
    ended, score = False, 0.0
    while not ended:
        states = agent.low_level_states(observation[None], np.array([1]))
        action = agent.low_level.act(states, np.zeros(1), np.zeros((1, 2)))[0]
        observation, _, terminated, truncated, info = env.step(action)
        ended, score = terminated or truncated, info.get("score", 0.0)
    assert score == BENT.optimum


def test_practice_does_not_claim_to_build_an_unknown_design() -> None:
    _, imagination = imagination_of()
    play(imagination, BUILT)
    assert imagination.beliefs(0).explores
    assert not imagination.practise(0, 1)


def test_practice_ended_from_outside_at_once_changes_no_networks() -> None:
    agent, imagination = imagination_of()
    play(imagination, BUILT)
    before = agent.low_level.engine.online.copy()
    session = imagination.session(0, 1)
    session.run(lambda: False)
    assert not imagination.builds_it_all(0, session)
    np.testing.assert_array_equal(agent.low_level.engine.online, before)


@pytest.mark.parametrize(("spec", "changed"), [(NESTED, [1]), (HIERARCHICAL, [2])], ids=["nested", "hierarchical"])
def test_practice_changes_only_the_agent_of_the_named_run_and_material(spec: AgentSpec, changed: list[int]) -> None:
    agent, imagination = imagination_of(2, spec)
    at_random(imagination, 3, run=1, runs=2)
    before = agent.low_level.engine.online.copy()
    imagination.practise(1, 0)
    differs = (agent.low_level.engine.online != before).any(axis=1)
    assert np.flatnonzero(differs).tolist() == changed


def test_a_hierarchical_agent_practises_with_its_own_materials_transitions_alone() -> None:
    for spec, held in ((HIERARCHICAL, [2, 3]), (NESTED, [5, 5])):
        _, imagination = imagination_of(spec=spec)
        play(imagination, [Action.F, Action.B], material=0)
        play(imagination, [Action.F, Action.L, Action.R], material=1)
        for material in (0, 1):
            real = imagination._real_transitions(0, material, np.zeros(5, dtype=np.int64))
            assert len(real.states) == len(real.actions) == len(real.landed) == held[material]


def test_the_same_run_practises_the_same_beside_others_and_alone() -> None:
    beside, imagination = imagination_of(3)
    alone, imagination_alone = imagination_of(1, numbers=[2])
    at_random(imagination, 3, run=2, runs=3)
    at_random(imagination_alone, 3)
    imagination.practise(2, 1)
    imagination_alone.practise(0, 1)
    np.testing.assert_array_equal(beside.low_level.engine.online[2], alone.low_level.engine.online[0])


def test_the_main_agent_chooses_untried_materials_first_and_then_the_best() -> None:
    agent, imagination = imagination_of()
    assert agent.main is not None

    def chosen() -> int:
        imagination.learn_choice(0)
        assert agent.main is not None
        return int(agent.main.act(np.array([BENT.start_state]), np.zeros(1), np.zeros((1, 2)))[0])

    built = [Action.FD, Action.RD, Action.BD]
    play(imagination, built, material=1)
    assert chosen() == 0, "as many blocks better than the best, since it was never tried"
    play(imagination, built, material=0)
    assert chosen() == 1


def test_first_steps_try_actions_whose_moves_are_unknown() -> None:
    _, imagination = imagination_of()
    rows, wanted = np.array([0]), np.array([int(Action.F)])
    assert imagination.act(rows, wanted).tolist() == [0], "the first that was never tried"
    play(imagination, [Action.B])  # it moved: where B leads is known
    assert imagination.act(rows, wanted).tolist() == [0]
    play(imagination, [Action.F])
    assert imagination.act(rows, wanted).tolist() == [int(Action.L)]


def test_an_action_that_never_moved_is_tried_again_rarely() -> None:
    _, imagination = imagination_of()
    rows, wanted = np.array([0]), np.array([int(Action.F)])
    play(imagination, [*range(7), *[Action.F, Action.B] * 3])
    play(imagination, [Action.B, Action.BD])  # against the edge: BD was tried and didn't move
    tried = []
    for _ in range(200):
        action = int(imagination.act(rows, wanted)[0])
        tried.append(action)
        play(imagination, [Action.B, Action.BD] if action == Action.BD else [action])
    tries = imagination.state()["tries"][0]
    assert 10 < tries[Action.BD] <= FIRST_TRIES * tries.sum() + 1
    assert set(tried) == {int(Action.F), int(Action.BD)}


def test_no_first_tries_are_made_once_the_design_is_known() -> None:
    _, imagination = imagination_of()
    imagination._explores[:] = False
    assert imagination.act(np.array([0]), np.array([5])).tolist() == [5]


def test_act_returns_actions_of_the_named_runs_alone() -> None:
    _, imagination = imagination_of(3)
    imagination._explores[:] = [False, True, False]
    assert imagination.act(np.array([0, 2]), np.array([5, 6, 7])).tolist() == [5, 7]
    assert imagination.act(np.array([], dtype=np.int64), np.array([5, 6, 7])).tolist() == []


@pytest.mark.parametrize("spec", [NESTED, HIERARCHICAL], ids=["nested", "hierarchical"])
def test_an_imagination_saved_in_mid_episode_continues_to_the_bit(spec: AgentSpec) -> None:
    agent, imagination = imagination_of(2, spec)
    at_random(imagination, 3, run=1, runs=2)
    imagination.begin(np.array([0]))
    here, after = np.tile(BENT.start_state, (2, 1)), np.tile((2, 2, 3), (2, 1))
    imagination.observe(np.array([0]), here, np.ones(2, np.int64), np.array([0, 0]), np.zeros(2), after)
    resumed_agent, resumed = imagination_of(2, spec)
    resumed.load(copied(imagination.state()))
    resumed_agent.load(copied(agent.state()))
    for each in (imagination, resumed):
        each.observe(np.array([0]), after, np.ones(2, np.int64), np.array([1, 0]), np.zeros(2), here)
        each.end(np.array([0]), np.ones(2, np.int64), np.full(2, 10.0))
        for run in (0, 1):
            each.learn_choice(run)
            each.practise(run, 1)
    for name, kept in {**imagination.state(), **agent.state()}.items():
        np.testing.assert_array_equal({**resumed.state(), **resumed_agent.state()}[name], kept, err_msg=name)


def test_arenas_of_different_sizes_are_learnt_side_by_side() -> None:
    large = BENT.__class__("large", TWO.design, TWO.start, TWO.step_limit, TWO.materials, size=7)
    agent = Agent(NESTED, [BENT, large], SMALL, 0)
    made = learnt_games_of(agent, [BENT, large], SMALL, 0)
    assert made is not None
    assert [len(made.beliefs(run).pay) for run in (0, 1)] == [5, 7]
    assert [made.beliefs(run).most for run in (0, 1)] == [3.0, 2.0]


def test_an_action_stopped_in_one_cell_is_tried_again_in_another_cell() -> None:
    to_the_edge = [Action.FD, Action.B, Action.B, Action.B]
    for actions, chosen in ((to_the_edge, Action.R), ([*to_the_edge, Action.R], Action.B)):
        _, imagination = imagination_of()
        play(imagination, actions)  # to (2, 0), at the edge, where B is stopped; on to (3, 0)
        imagination._untried[0], imagination._tries[0, Action.F] = np.arange(8) == Action.B, 100
        assert imagination.act(np.array([0]), np.array([int(Action.R)])).tolist() == [chosen]


@pytest.mark.parametrize("falls_short", [False, True])
def test_an_untried_action_is_tried_on_a_known_design_only_if_practice_fell_short(falls_short: bool) -> None:
    _, imagination = imagination_of()
    play(imagination, [Action.FD, Action.R, Action.FD, Action.F])
    session = imagination.session(0, 1)
    session._progress.reached[0], session._progress.best_score[0] = not falls_short, session._goal.aim
    imagination._explores[0] = False  # every cell that pays is known
    assert imagination.builds_it_all(0, session) != falls_short
    chosen = imagination.act(np.array([0]), np.array([int(Action.R)]))
    assert (chosen[0] != Action.R) == falls_short


@pytest.mark.parametrize(
    ("explored", "fell_short", "explores", "anew"),
    [(False, True, False, True), (True, True, False, False), (False, False, False, False), (False, True, True, False)],
)
def test_networks_begin_anew_only_after_falling_short_of_the_same_known_design(
    explored: bool, fell_short: bool, explores: bool, anew: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, imagination = imagination_of()
    play(imagination, [Action.FD, Action.R, Action.FD, Action.F])
    imagination._explores[0], imagination._falls_short[0] = explored, fell_short
    believed = dataclasses.replace(imagination.beliefs(0), explores=explores)
    monkeypatch.setattr(imagination, "beliefs", lambda *_: believed)
    assert imagination.session(0, 1)._goal.anew == anew


def test_an_action_that_does_not_move_is_counted_once_per_cell_and_episode() -> None:
    _, imagination = imagination_of()
    play(imagination, [Action.B, *[Action.B] * 9, Action.R, Action.B])  # to (2, 0), where it is stopped; to (3, 0)
    play(imagination, [Action.B, Action.B])
    assert imagination.state()["tries"][0].tolist() == [0, 5, 0, 1, 0, 0, 0, 0]
