"""Algorithm 1, tick by tick: what is stored, when there are updates, what is evaluated, and that it can be repeated."""

from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Arrays, Float32s, Int64s
from mc_nested.learn.agents import AGENT_SPECS, Agent, AgentSpec
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.exploration.return_then_explore import Excursions
from mc_nested.learn.learner import Learner
from mc_nested.learn.preset import ExcursionRule, Imitation, MainUpdates, Preset, Prioritized
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.arena.made_games import PERSON, PlayedByAPerson
from tests.arena.simulated import arena_env
from tests.learn.made_trainings import SHORT, Slips, StartsOver, assert_same, copied, finish, saved, ticked

LINE, DIAMOND = load_scenario("line"), load_scenario("diamond")
NESTED, HIERARCHICAL, SINGLE = AGENT_SPECS["nested"], AGENT_SPECS["hierarchical"], AGENT_SPECS["single"]


def trainer_of(
    scenarios: Sequence[Scenario],
    preset: Preset = SHORT,
    seed: int = 0,
    stop_at_optimum: bool = False,
    spec: AgentSpec = NESTED,
) -> Trainer:
    agent = Agent(spec, scenarios, preset, seed)
    env = agent.view_of(GridVectorEnv(scenarios), scenarios)
    return Trainer(env, scenarios, agent, preset, seed, stop_at_optimum)


def trainer_in(arenas: Any, scenarios: Sequence[Scenario], preset: Preset = SHORT) -> Trainer:
    """Return a nested agent's training in these arenas."""
    return Trainer(arenas, scenarios, Agent(NESTED, scenarios, preset, 0), preset, 0)


def test_epsilon_falls_with_the_episodes_of_each_run_and_is_the_same_after_loading() -> None:
    trainer = finish(trainer_of([LINE, DIAMOND]))
    # The paper's: the nested agent's reaches its floor after 60 % of the episodes, the main agent's after 18 %.
    assert [row.epsilon_nested for row in trainer.episode_rows if row.trial == 1][:13] == pytest.approx(
        [max(1 - 0.999 * done / 12, 0.001) for done in range(13)]
    )
    resumed = trainer_of([LINE, DIAMOND])
    assert resumed.epsilon[1].tolist() == [1.0, 1.0]
    resumed.load(trainer.state(), [])
    np.testing.assert_array_equal(resumed.epsilon, trainer.epsilon)
    assert resumed.epsilon[0] == pytest.approx([0.01, 0.01])


def test_a_training_of_a_billion_episodes_can_begin() -> None:
    trainer = trainer_of([LINE], SHORT.model_copy(update={"episodes": 10**9}))
    trainer.tick()
    assert trainer.epsilon[1].tolist() == [1.0]


def _learners(agent: Agent) -> list[Learner]:
    return [learner for learner in (agent.main, agent.low_level) if learner is not None]


def main_of(agent: Agent) -> Learner:
    assert agent.main is not None
    return agent.main


def kept_by(learner: Learner, row: int) -> Arrays:
    """Return the transitions that a row remembers, oldest first."""
    every = learner.replay.added_since(None)
    ends = np.cumsum(every["counts"])
    return {name: kept[ends[row] - every["counts"][row] : ends[row]] for name, kept in every.items()}


def added_to(agent: Agent) -> list[list[int]]:
    """Return how many transitions each row of each learner has stored."""
    return [learner.replay.added.tolist() for learner in _learners(agent)]


def weights(trainer: Trainer, run: int) -> list[Float32s]:
    return [learner.engine.online[run] for learner in _learners(trainer.agent)]


@pytest.fixture(scope="module")
def three_runs() -> Trainer:
    return finish(trainer_of([LINE, LINE, LINE]))


def test_every_run_has_its_episodes_in_order(three_runs: Trainer) -> None:
    for run in range(3):
        rows = [row for row in three_runs.episode_rows if row.trial == run]
        assert [row.episode for row in rows] == list(range(1, 21))
        assert all(11 <= row.steps <= 60 for row in rows)
        assert all(-5 <= row.score <= 21 for row in rows)


def test_there_is_a_greedy_evaluation_every_5_episodes(three_runs: Trainer) -> None:
    for run in range(3):
        assert [row.episode for row in three_runs.evaluation_rows if row.trial == run] == [5, 10, 15, 20]


def test_a_training_of_13_episodes_ends_with_an_evaluation() -> None:
    trainer = finish(trainer_of([LINE], SHORT.model_copy(update={"episodes": 13})))
    assert [row.episode for row in trainer.evaluation_rows] == [5, 10, 13]


def test_the_nested_agent_updates_once_a_step_and_the_main_agent_once_an_episode(three_runs: Trainer) -> None:
    steps = sum(row.steps for row in three_runs.episode_rows)
    assert three_runs.env_steps == steps
    assert int(three_runs.agent.low_level.replay.added.sum()) == steps
    assert main_of(three_runs.agent).replay.added.tolist() == [20] * 3
    # From 16 transitions on: the first 15 steps, and the first 15 episodes, bring none.
    assert int(three_runs.agent.low_level.engine.updates.sum()) == steps - 3 * 15
    assert main_of(three_runs.agent).engine.updates.tolist() == [5] * 3


def test_a_presets_main_table_lets_the_main_agent_learn_from_its_second_episode_on() -> None:
    preset = SHORT.model_copy(update={"episodes": 4, "main": MainUpdates(learning_starts=2, updates_an_episode=50)})
    agent = finish(trainer_of([LINE, LINE], preset)).agent
    assert main_of(agent).engine.updates.tolist() == [150] * 2
    chosen = main_of(agent).act(np.array([[7, 14, 11]] * 2), np.zeros(2), np.ones((2, 2)))
    for run in (0, 1):
        kept = kept_by(main_of(agent), run)
        tried = {int(material): kept["rewards"][kept["actions"] == material].mean() for material in kept["actions"]}
        assert len(tried) == 1 or chosen[run] == max(tried, key=lambda material: tried[material])
    alone = finish(trainer_of([LINE], preset)).agent
    np.testing.assert_array_equal(main_of(alone).engine.online[0], main_of(agent).engine.online[0])


def test_a_presets_main_table_does_not_change_the_nested_agents_random_numbers() -> None:
    preset = SHORT.model_copy(update={"episodes": 2, "evaluate_every": 10})
    with_table = preset.model_copy(update={"main": MainUpdates(learning_starts=2, updates_an_episode=3)})
    one, other = finish(trainer_of([LINE], preset)), finish(trainer_of([LINE], with_table))
    assert one.episode_rows == other.episode_rows


def test_evaluation_steps_counts_the_steps_of_all_evaluations(three_runs: Trainer) -> None:
    assert three_runs.evaluation_steps == sum(row.steps for row in three_runs.evaluation_rows)


def test_the_main_agent_stores_the_start_its_choice_and_the_score_of_each_episode(three_runs: Trainer) -> None:
    kept = kept_by(main_of(three_runs.agent), 1)
    rows = [row for row in three_runs.episode_rows if row.trial == 1]
    start = main_of(three_runs.agent).states.encoded(np.array([7, 14, 11]))
    assert kept["states"][:, 0].tolist() == [start] * 20
    assert kept["actions"].tolist() == [row.material for row in rows]
    assert kept["rewards"].tolist() == [row.score for row in rows]
    assert not kept["discounts"][1].any()


def test_the_nested_agents_states_carry_the_main_action(three_runs: Trainer) -> None:
    kept = kept_by(three_runs.agent.low_level, 2)
    rows = [row for row in three_runs.episode_rows if row.trial == 2]
    carried = np.concatenate([[row.material] * row.steps for row in rows])
    # a_M comes last in a nested state, so it is what is left of its number when divided by the two materials.
    assert (kept["states"] % 2).tolist() == [[material] * 2 for material in carried]
    assert set(carried) == {0, 1}


def test_truncation_bootstraps_and_termination_does_not(three_runs: Trainer) -> None:
    kept = kept_by(three_runs.agent.low_level, 0)
    rows = [row for row in three_runs.episode_rows if row.trial == 0]
    ends = np.cumsum([row.steps for row in rows]) - 1
    terminated = kept["discounts"] == 0
    blocks_left = kept["states"][:, 1] // 2 % 12
    np.testing.assert_array_equal(terminated, blocks_left == 0)
    assert set(np.flatnonzero(terminated)) <= set(ends)
    assert len(set(ends) - set(np.flatnonzero(terminated))) > 0, "some early episode ran out of steps"


def test_the_same_seed_trains_the_same_and_another_does_not(three_runs: Trainer) -> None:
    again, other = finish(trainer_of([LINE] * 3)), finish(trainer_of([LINE] * 3, seed=1))
    assert_same(again, three_runs)
    for run in range(3):
        for one, same in zip(weights(three_runs, run), weights(again, run), strict=True):
            assert np.array_equal(one, same)
    assert other.episode_rows != three_runs.episode_rows


def test_runs_of_one_training_differ(three_runs: Trainer) -> None:
    by_run = [[row.score for row in three_runs.episode_rows if row.trial == run] for run in range(3)]
    assert by_run[0] != by_run[1] != by_run[2]


def test_a_run_trains_the_same_alone_and_in_a_batch(three_runs: Trainer) -> None:
    alone = finish(trainer_of([LINE]))
    assert alone.episode_rows == [row for row in three_runs.episode_rows if row.trial == 0]
    for one, same in zip(weights(three_runs, 0), weights(alone, 0), strict=True):
        np.testing.assert_array_equal(one, same)


@pytest.mark.parametrize("ticks", [1, 200, 450])
def test_a_resumed_training_continues_to_the_bit(three_runs: Trainer, ticks: int) -> None:
    resumed = trainer_of([LINE] * 3)
    resumed.load(*saved(ticked(trainer_of([LINE] * 3), ticks)))
    assert_same(finish(resumed), three_runs)
    assert (resumed.ticks, resumed.env_steps) == (three_runs.ticks, three_runs.env_steps)


def test_a_resumed_training_begins_a_new_episode_in_a_game_that_can_not_be_saved() -> None:
    first, resumed = (trainer_in(ArenaVectorEnv([ArenaEnv(StartsOver(LINE), LINE)]), [LINE]) for _ in range(2))
    resumed.load(*saved(ticked(first, 100)))
    done = int(resumed.episodes_done[0])
    assert 0 < done < 20
    assert [row.episode for row in finish(resumed).episode_rows] == list(range(1, 21))


def test_single_games_and_arrays_train_the_same(three_runs: Trainer) -> None:
    trainer = trainer_in(ArenaVectorEnv([arena_env(LINE) for _ in range(3)]), [LINE] * 3)
    assert finish(trainer).episode_rows == three_runs.episode_rows


def test_single_games_resume_in_mid_episode_as_arrays_do(three_runs: Trainer) -> None:
    envs = [ArenaVectorEnv([arena_env(LINE) for _ in range(3)]) for _ in range(2)]
    first, resumed = (trainer_in(games, [LINE] * 3) for games in envs)
    resumed.load(*saved(ticked(first, 130)))
    assert finish(resumed).episode_rows == three_runs.episode_rows


def test_arenas_in_a_gymnasium_wrapper_train_the_same(three_runs: Trainer) -> None:
    trainer = trainer_in(RecordEpisodeStatistics(GridVectorEnv([LINE] * 3)), [LINE] * 3)
    assert finish(trainer).episode_rows == three_runs.episode_rows


def test_different_designs_train_side_by_side() -> None:
    trainer = finish(trainer_of([LINE, DIAMOND], SHORT.model_copy(update={"episodes": 5})))
    assert [kept_by(trainer.agent.low_level, run)["states"][0, 0] // 2 % 17 for run in (0, 1)] == [11, 16]


def test_a_run_that_stops_at_the_optimum_keeps_a_policy_that_reaches_the_optimum() -> None:
    dot = Scenario("dot", frozenset({(7, 14)}), (7, 12), 4, LINE.materials)
    preset = SHORT.model_copy(update={"episodes": 400})
    trainer = finish(trainer_of([dot, dot], preset, stop_at_optimum=True))
    last = {row.trial: row for row in trainer.evaluation_rows}
    assert [last[run].score for run in (0, 1)] == [11.0, 11.0]
    assert [last[run].episode for run in (0, 1)] == trainer.episodes_done.tolist()
    assert trainer.episodes_done.max() < 400
    env = GridVectorEnv([dot, dot])
    assert [episode.score for episode in play_greedily(env, [dot, dot], trainer.agent)] == [11.0, 11.0]


def test_the_trained_policy_plays_its_last_evaluation_again(three_runs: Trainer) -> None:
    played = play_greedily(GridVectorEnv([LINE] * 3), [LINE] * 3, three_runs.agent)
    last = {row.trial: row for row in three_runs.evaluation_rows}
    assert [episode.score for episode in played] == [last[run].score for run in range(3)]
    assert [episode.material for episode in played] == [last[run].material for run in range(3)]
    assert [len(episode.actions) for episode in played] == [last[run].steps for run in range(3)]


SCOUTING = SHORT.model_copy(
    update={
        "episodes": 60,
        "evaluate_every": 5,
        "encoding": "one-hot",
        "keep": "best",
        "updates_a_step": 2,
        "explore_nested": None,
        "excursions": ExcursionRule(at_end=0.1, wander=12, rejoin=0.4, repeat=0.8),
        "imitation": Imitation(batch=4, margin=0.5),
    }
)


@pytest.fixture(scope="module")
def exploring() -> Trainer:
    return finish(trainer_of([LINE, DIAMOND], SCOUTING))


def test_excursions_remember_greedy_evaluations_without_storing_their_transitions() -> None:
    trainer = trainer_of([LINE], SCOUTING)
    trainer.begin_from({role: online[[0]] for role, online in trainer.agent.online().items()})
    excursions = trainer.practice
    assert isinstance(excursions, Excursions)
    while not trainer.evaluation_rows:
        trainer.tick()
    assert not trainer.episode_rows, "the first episode is greedy: its policy was begun from"
    assert (excursions._explorers[0]._effects != 0).any()
    assert trainer.agent.low_level.replay.added.tolist() == [0]
    assert trainer.agent.updates == 0


def test_excursions_find_higher_scores_than_epsilon_exploration(exploring: Trainer) -> None:
    by_chance = finish(trainer_of([LINE, DIAMOND], SHORT.model_copy(update={"episodes": 60})))
    for run in (0, 1):
        best = [max(row.score for row in t.episode_rows if row.trial == run) for t in (exploring, by_chance)]
        assert best[0] > best[1]


def test_excursions_follow_the_best_episode_only_from_its_own_states_despite_slips() -> None:
    trainer = trainer_in(Slips([LINE], 0.1, seed=3), [LINE], SCOUTING)
    excursions = trainer.practice
    assert isinstance(excursions, Excursions)
    one = excursions._explorers[0]
    followed, left = 0, 0
    while not trainer.finished:
        best, walked, leaves_at = list(one.best), len(one._walk), one._leave_at
        following, observation = one._following, trainer._episodes.observations[0].copy()
        between = bool(trainer._episodes.between_episodes[0] or trainer._episodes.evaluating[0])
        trainer.tick()
        if following is None or between or walked >= leaves_at:
            continue
        placed = sum(step.used_block for step in best[:following])
        if (best[following].x, best[following].y, 11 - placed) == tuple(observation[:3]):
            followed += 1
        else:
            left += 1
            assert one._leave_at <= walked, "what comes next in the best episode belongs to another state"
    assert followed > 100
    assert left > 5


def test_a_run_keeps_its_best_policy_where_the_preset_says_so(exploring: Trainer) -> None:
    scores = [max(row.score for row in exploring.evaluation_rows if row.trial == run) for run in (0, 1)]
    assert exploring.policy_scores.tolist() == scores
    agent = Agent(NESTED, [LINE, DIAMOND], SCOUTING, seed=0)
    for role, online in agent.online().items():
        online[:] = exploring.state()[f"policies.{role}"]
    played = play_greedily(GridVectorEnv([LINE, DIAMOND]), [LINE, DIAMOND], agent)
    assert [episode.score for episode in played] == scores


def test_a_training_begun_from_a_policy_keeps_that_policy_and_evaluates_first(exploring: Trainer) -> None:
    online = {role: kept[[0]] for role, kept in exploring.agent.online().items()}
    trainer = trainer_of([LINE, DIAMOND], SCOUTING)
    trainer.begin_from(online)
    for role, taken in online.items():
        np.testing.assert_array_equal(trainer.state()[f"policies.{role}"], np.concatenate([taken, taken]))
    while not trainer.evaluation_rows:
        trainer.tick()
    assert trainer.evaluation_rows[0].episode == 0


def test_the_preset_sets_the_number_of_updates_per_step(exploring: Trainer) -> None:
    steps = sum(row.steps for row in exploring.episode_rows)
    assert int(exploring.agent.low_level.engine.updates.sum()) == 2 * (steps - 2 * 15)


@pytest.mark.parametrize("spec", [NESTED, HIERARCHICAL], ids=["nested", "hierarchical"])
def test_excursions_resume_to_the_bit_and_train_the_same_alone(spec: AgentSpec) -> None:
    preset = SCOUTING.model_copy(update={"episodes": 15})
    whole, first, resumed = (trainer_of([LINE] * 2, preset, spec=spec) for _ in range(3))
    resumed.load(*saved(ticked(first, 333)))
    assert_same(finish(resumed), finish(whole))
    agent = Agent(spec, [LINE], preset, 0, runs=[1])
    alone = finish(Trainer(GridVectorEnv([LINE]), [LINE], agent, preset, 0))
    assert [row[1:] for row in alone.episode_rows] == [row[1:] for row in whole.episode_rows if row.trial == 1]


def test_a_training_with_prioritized_replay_resumes_to_the_bit() -> None:
    preset = SHORT.model_copy(update={"prioritized": Prioritized(alpha=0.6, beta=0.5)})
    whole, first, resumed = (trainer_of([LINE] * 2, preset) for _ in range(3))
    resumed.load(*saved(ticked(first, 400)))
    assert_same(finish(resumed), finish(whole))
    assert finish(trainer_of([LINE] * 2)).episode_rows != whole.episode_rows


class Fails(GridVectorEnv):
    """Breaks down once, in the middle of an episode."""

    fails_at = 50

    def step(self, actions: Int64s) -> Any:
        self.fails_at -= 1
        if self.fails_at == 0:
            raise ConnectionError("the game is gone")
        return super().step(actions)


def test_training_goes_on_with_a_new_episode_after_an_error_of_the_env() -> None:
    trainer = trainer_in(Fails([LINE]), [LINE])
    with pytest.raises(ConnectionError):
        finish(trainer)
    trainer.abandon_episodes()
    assert [row.episode for row in finish(trainer).episode_rows] == list(range(1, 21))


FEW_EXCURSIONS = SCOUTING.model_copy(update={"episodes": 20})


@pytest.mark.parametrize(
    ("spec", "preset"),
    [(NESTED, SHORT), (HIERARCHICAL, SHORT), (SINGLE, SHORT), (NESTED, FEW_EXCURSIONS), (HIERARCHICAL, FEW_EXCURSIONS)],
)
def test_an_abandoned_episode_is_never_learnt_from(spec: AgentSpec, preset: Preset) -> None:
    game = StartsOver(LINE)
    game.acts_left = 50
    agent = Agent(spec, [LINE], preset, 0)
    trainer = Trainer(agent.view_of(ArenaVectorEnv([ArenaEnv(game, LINE)]), [LINE]), [LINE], agent, preset, 0)
    known: list[tuple[Arrays, list[list[int]]]] = []
    ended = 0
    with suppress(ConnectionError):
        while trainer.ticks < 100:
            trainer.tick()
            if len(trainer.episode_rows) + len(trainer.evaluation_rows) > ended:
                ended = len(trainer.episode_rows) + len(trainer.evaluation_rows)
                known.append((copied(agent.state()), added_to(agent)))
    assert trainer.ticks < 100, "the fiftieth action broke down"
    trainer.abandon_episodes()
    before, added = known[-1]
    assert added_to(agent) == added
    for name, kept in before.items():
        assert np.array_equal(agent.state()[name], kept), name
    assert [row.episode for row in finish(trainer).episode_rows] == list(range(1, 21))


@pytest.mark.parametrize("capacity", [40, 90, 1_000_000])
@pytest.mark.parametrize("ticks_after", [3, 25, 70])
def test_journals_around_a_mishap_restore_the_replay_of_the_training_that_went_on(
    capacity: int, ticks_after: int
) -> None:
    preset = FEW_EXCURSIONS.model_copy(update={"replay_capacity": capacity})

    game = StartsOver(LINE)
    games = game, StartsOver(LINE)
    trainer, resumed = (trainer_in(ArenaVectorEnv([ArenaEnv(each, LINE)]), [LINE], preset) for each in games)
    while not (len(trainer.episode_rows) == 3 and trainer.state()["runs.steps_in_episode"][0] == 30):
        trainer.tick()
    journals, marks = [trainer.journal(None)], trainer.marks()  # a save, thirty steps into an episode
    game.acts_left = 4
    with pytest.raises(ConnectionError):
        finish(trainer)
    trainer.abandon_episodes()
    ticked(trainer, ticks_after)
    journals.append(trainer.journal(marks))
    resumed.load(copied(trainer.state()), journals)
    for one, other in zip(_learners(trainer.agent), _learners(resumed.agent), strict=True):
        held, brought_back = kept_by(one, 0), kept_by(other, 0)
        for name, kept in held.items():
            np.testing.assert_array_equal(brought_back[name], kept)


@pytest.mark.parametrize(
    ("spec", "networks", "parameters"),
    [
        # Main: 3·32 + 32 + 32·32 + 32 + 32·2 + 2 = 1250; nested: 1480; a low agent without a_M: 1448; single, with two
        # actions more: 1546.
        (NESTED, 2, 1250 + 1480),
        (HIERARCHICAL, 3, 1250 + 2 * 1448),
        (SINGLE, 1, 1546),
    ],
    ids=list(AGENT_SPECS),
)
def test_the_nested_hierarchical_and_single_agents_train_2_3_and_1_networks(
    spec: AgentSpec, networks: int, parameters: int
) -> None:
    agent = Agent(spec, [LINE], SHORT, 0)
    assert (agent.networks, agent.parameters) == (networks, parameters)


def test_each_low_agent_of_the_hierarchy_learns_from_its_own_material_alone() -> None:
    trainer = finish(trainer_of([LINE] * 2, spec=HIERARCHICAL))
    for run in (0, 1):
        for material in (0, 1):
            rows = [row for row in trainer.episode_rows if (row.trial, row.material) == (run, material)]
            assert trainer.agent.low_level.replay.added[2 * run + material] == sum(row.steps for row in rows)
    assert trainer.agent.low_level.engine.form.numbers[0] == 3, "nothing of the top agent is in the low agents' state"
    added = trainer.agent.low_level.replay.added
    assert trainer.agent.low_level.engine.updates.tolist() == np.maximum(added - 15, 0).tolist()


def test_the_single_agent_learns_from_its_choice_as_from_any_action() -> None:
    trainer = finish(trainer_of([LINE] * 2, SHORT.model_copy(update={"episodes": 60}), spec=SINGLE))
    for run in (0, 1):
        kept = kept_by(trainer.agent.low_level, run)
        rows = [row for row in trainer.episode_rows if row.trial == run]
        begins = np.concatenate(([0], np.cumsum([row.steps for row in rows])[:-1]))
        unchosen = trainer.agent.low_level.states.encoded(np.array([7, 14, 11, 0]))
        assert kept["states"][begins, 0].tolist() == [unchosen] * 60
        choices = kept["actions"][begins].astype(int)
        assert [row.material for row in rows] == np.where(choices < 2, choices, -1).tolist()
        assert kept["rewards"][begins].tolist() == [{0: -5.0, 1: 10.0}.get(int(choice), 0.0) for choice in choices]
        assert [row.score for row in rows if row.material == -1] == [0.0] * int((choices >= 2).sum())
    assert {row.material for row in trainer.episode_rows} == {-1, 0, 1}


@pytest.mark.parametrize("spec", [HIERARCHICAL, SINGLE], ids=["hierarchical", "single"])
def test_trainings_of_the_hierarchical_and_single_agents_resume_to_the_bit(spec: AgentSpec) -> None:
    whole, first, resumed = (trainer_of([LINE] * 2, spec=spec) for _ in range(3))
    resumed.load(*saved(ticked(first, 150)))
    assert_same(finish(resumed), finish(whole))
    played = play_greedily(whole.agent.view_of(GridVectorEnv([LINE] * 2), [LINE] * 2), [LINE] * 2, whole.agent)
    last = {row.trial: row for row in whole.evaluation_rows}
    assert [(episode.score, episode.material) for episode in played] == [
        (last[run].score, last[run].material) for run in (0, 1)
    ]


@pytest.mark.parametrize("spec", AGENT_SPECS.values(), ids=list(AGENT_SPECS))
def test_a_run_of_any_agent_trains_the_same_alone_and_in_a_batch(spec: AgentSpec) -> None:
    preset = SHORT.model_copy(update={"episodes": 10})
    beside, alone = finish(trainer_of([LINE] * 3, preset, spec=spec)), finish(trainer_of([LINE], preset, spec=spec))
    assert alone.episode_rows == [row for row in beside.episode_rows if row.trial == 0]


def test_what_a_person_did_instead_is_learnt_as_the_action() -> None:
    trainer = trainer_in(ArenaVectorEnv([ArenaEnv(PlayedByAPerson(LINE, 1), LINE)]), [LINE])
    for _ in range(3):
        trainer.tick()
    assert kept_by(trainer.agent.low_level, 0)["actions"][:2].tolist() == list(PERSON)


def test_an_evaluation_in_which_a_person_acted_becomes_a_training_episode() -> None:
    # The first evaluation comes after five episodes, so the sixth reset begins it.
    alone, helped = (
        finish(trainer_in(ArenaVectorEnv([ArenaEnv(PlayedByAPerson(LINE, episodes), LINE)]), [LINE]))
        for episodes in (5, 6)
    )
    assert [row.episode for row in alone.evaluation_rows] == [5, 10, 15, 20]
    assert [row.episode for row in helped.evaluation_rows] == [10, 15, 20]
    assert (alone.demonstrated.tolist(), helped.demonstrated.tolist()) == ([5], [6])
