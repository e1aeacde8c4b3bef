"""Trainings with objectives: their phases, their lessons by hand, resumed to the bit."""

from typing import get_args

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arrays import Bools
from mc_nested.errors import PresetError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.dqn.states import AGENT, OCCUPIED, WANTED, Sees
from mc_nested.learn.evaluation import build_greedily
from mc_nested.learn.objective_lessons import MainLessons, rate_after
from mc_nested.learn.objective_training import ObjectivesTraining
from mc_nested.learn.objectives.decide import ObjectiveAgent, built_by_the_rules
from mc_nested.learn.objectives.networks import Reaching, ReachNetwork
from mc_nested.learn.preset import load_preset
from sim.grid import GridGame
from tests.learn.made_trainings import assert_same, saved
from tests.learn.objectives.made_objectives import both_by_chance, small, training_of

LINE = load_scenario("line")
SEES: tuple[Sees, ...] = get_args(Sees)


def finished(training: ObjectivesTraining) -> ObjectivesTraining:
    while not training.finished:
        training.tick()
    return training


def test_the_nested_agent_learns_first_then_the_main_agent() -> None:
    training = training_of(LINE, small())
    main = training.agent.online()["main"].copy()
    training.tick()
    says = "the nested agent learns first, with 12 updates; then the main agent, on 12 designs"
    assert training.practice.untold == [says]
    while training.agent.low_level.engine.updates[0] < 12:
        assert training.episodes_done[0] == 0
        training.tick()
    np.testing.assert_array_equal(training.agent.online()["main"], main)
    nested = training.agent.online()["low"].copy()
    finished(training)
    np.testing.assert_array_equal(training.agent.online()["low"], nested)
    assert not np.array_equal(training.agent.online()["main"], main)


def test_every_design_is_an_episode_and_evaluations_are_of_the_scenario() -> None:
    training = finished(training_of(LINE, small()))
    assert [row.episode for row in training.episode_rows] == list(range(1, 13))
    assert all(0 <= row.score <= LINE.optimum for row in training.episode_rows)
    assert training.evaluation_rows[-1].episode == 12
    assert training.evaluation_rows[-1].steps <= LINE.step_limit


def test_a_training_resumes_to_the_bit_in_both_phases() -> None:
    whole = finished(training_of(LINE, small()))
    for share in (0.1, 0.9):
        first, resumed = (training_of(LINE, small()) for _ in range(2))
        while first.ticks < share * whole.ticks:
            first.tick()
        resumed.load(*saved(first))
        assert_same(finished(resumed), whole)


@pytest.mark.parametrize("scenario", [LINE, load_scenario("flag")], ids=["line", "flag, in parts"])
def test_what_was_trained_plays_as_in_its_last_evaluation(scenario: Scenario) -> None:
    training = finished(training_of(scenario, small()))
    played = build_greedily(ArenaEnv(GridGame(scenario), scenario), training.agent)
    last = training.evaluation_rows[-1]
    assert (played.score, len(played.actions)) == (last.score, last.steps)


@pytest.mark.parametrize("sees", SEES)
def test_evaluations_and_greedy_play_show_the_nested_agent_as_much_as_its_lessons(sees: Sees) -> None:
    networks = both_by_chance(3)  # these take another number of steps for each
    update = small().update.model_copy(update={"learning_rate": 1e-30})
    preset = small(nested_sees=sees, main_update=update)
    training = training_of(LINE, preset.model_copy(update={"update": update}))
    training.agent.load_online({role: network[None] for role, network in zip(("main", "low"), networks, strict=True)})
    finished(training)
    played = build_greedily(ArenaEnv(GridGame(LINE), LINE), training.agent)
    steps = built_by_the_rules(ObjectiveAgent(*networks, LINE, sees), LINE).steps
    assert training.evaluation_rows[-1].steps == len(played.actions) == steps


def transitions(training: ObjectivesTraining, role: str) -> list[tuple[np.ndarray, np.ndarray, int, float, float]]:
    """Return every transition in a replay: the planes of s and s', the action, the reward and the discount."""
    learner = training.agent.main if role == "main" else training.agent.low_level
    assert learner
    kept = learner.replay.gather(np.zeros(1, np.int64), np.arange(learner.replay.added[0])[None])
    side = 8
    planes = np.unpackbits(kept.states.astype(np.uint8), axis=-1).reshape(*kept.states.shape[:-1], -1, side, side)
    parts = zip(planes[0, 0], planes[1, 0], kept.actions[0], kept.rewards[0], kept.discounts[0], strict=True)
    return [
        (before, after, int(action), float(reward), float(discount))
        for before, after, action, reward, discount in parts
    ]


@pytest.mark.parametrize("hindsight", [True, False])
def test_the_nested_agent_is_paid_for_a_block_on_its_objective_and_learns_from_what_was_reached_instead(
    hindsight: bool,
) -> None:
    training = training_of(LINE, small(hindsight=hindsight))
    for _ in range(25):
        training.tick()
    found = transitions(training, "low")
    paid = [each for each in found if each[3] == 1.0]
    assert bool(paid) == (hindsight or any(each[3] for each in found))
    for before, after, action, _, discount in paid:
        assert discount == 0.0
        assert action >= Action.FD
        (x, y), (front_x, front_y) = np.argwhere(after[AGENT])[0], np.argwhere(before[WANTED])[0]
        assert (front_x, front_y) == (x, y + 1)
        assert not before[OCCUPIED, front_x, front_y]
    share = len(paid) / len(found)
    assert (share > 0.2) == hindsight  # half of all actions by chance place a block


@pytest.mark.parametrize("sees", SEES)
def test_the_nested_agent_learns_from_what_it_is_shown(sees: Sees) -> None:
    training = training_of(LINE, small(nested_sees=sees))
    for _ in range(10):
        training.tick()
    seen = np.array([state for before, after, *_ in transitions(training, "low") for state in (before, after)])
    assert seen[:, OCCUPIED, 1:-1, 1:-1].any() == (sees != "objective")
    assert set(seen[:, WANTED].sum((1, 2))) == {64 if sees == "surroundings" else 1}
    assert (seen[:, AGENT].sum((1, 2)) == 1).all()


class Watched(ReachNetwork):
    """A nested agent's network that learnt nothing, and keeps what it was last shown."""

    def __init__(self) -> None:
        super().__init__(both_by_chance(1)[1])

    def reaching(self, planes: Bools) -> Reaching:
        self.shown = planes
        return super().reaching(planes)


@pytest.mark.parametrize("sees", SEES)
def test_the_main_agent_learns_through_a_nested_agent_that_is_shown_as_much(sees: Sees) -> None:
    preset, nested = small(nested_sees=sees), Watched()
    agent = Agent(AGENT_SPECS["nested"], [LINE], preset, 0)
    assert agent.main
    assert preset.objectives
    MainLessons(agent.main, preset.objectives).round(np.random.default_rng(1), nested, 1.0, 0.0)
    assert nested.shown[:, OCCUPIED, 1:-1, 1:-1].any() == (sees != "objective"), "beside a small arena all is occupied"
    assert set(nested.shown[:, WANTED].sum((1, 2))) == {64 if sees == "surroundings" else 1}


def test_the_main_agent_is_paid_by_block_step_and_loss() -> None:
    training = finished(training_of(LINE, small()))
    for before, after, action, reward, discount in transitions(training, "main"):
        assert before[WANTED].reshape(-1)[int(action)]
        gone = int(before[WANTED].sum() - after[WANTED].sum())
        has_built = after[OCCUPIED].sum() > before[OCCUPIED].sum() and gone > 0
        steps = (0.2 - reward) / 0.06
        if has_built and gone == 1 and reward > -0.9:
            assert steps == pytest.approx(round(steps), abs=1e-4)
            assert round(steps) >= 1
        if gone > 1:
            assert reward <= 0.2 - 0.06 - 1.0 + 1e-4
        assert reward >= -2.0
        assert discount in (0.0, pytest.approx(0.99))
        assert (discount == 0.0) or after[WANTED].any()


def test_the_learning_rate_falls_towards_the_end() -> None:
    assert [rate_after(share) for share in (0.0, 0.59, 0.6, 0.84, 0.85, 1.0, 1.2)] == [1, 1, 0.3, 0.3, 0.1, 0.1, 0.1]


def test_two_runs_at_once_are_refused() -> None:
    preset = small()
    agent = Agent(AGENT_SPECS["nested"], [LINE] * 2, preset, 0)
    with pytest.raises(PresetError, match="leave out --trials"):
        ObjectivesTraining([LINE] * 2, agent, preset, 0)


@pytest.mark.parametrize("kind", ["single", "hierarchical"])
def test_the_nested_agent_alone_has_objectives(kind: str) -> None:
    with pytest.raises(PresetError, match=r"\[objectives\] is for the nested agent: take that, or"):
        Agent(AGENT_SPECS[kind], [LINE], small(), 0)


def test_objectives_need_their_states_and_their_network() -> None:
    with pytest.raises(PresetError, match="go together"):
        load_preset("any-design").changed(states="image")
