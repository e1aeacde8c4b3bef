"""Several builders in one arena: what each sees, which row plays whom, what is shared, and how they train."""

import numpy as np
import pytest

from mc_nested.errors import PresetError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import MainUpdates, Preset, Prioritized, load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.made_trainings import PAPER, SHORT, assert_same, finish, saved, ticked
from tests.learn.teams import LINE, agent_of, arenas_of, trainer_of

SEEN = np.array([[7, 14, 11], [3, 2, 11], [0, 0, 4], [1, 1, 4]])
BOTH = np.array([0, 1])


@pytest.mark.parametrize("networks", ["shared", "own"])
def test_a_nested_agents_state_is_its_cell_the_blocks_its_number_and_the_main_action(networks: Networks) -> None:
    states = agent_of(networks, 2).low_level_states(SEEN, np.array([1, 0]))
    assert states.tolist() == [[7, 14, 11, 0, 1], [3, 2, 11, 1, 1], [0, 0, 4, 0, 0], [1, 1, 4, 1, 0]]


def test_the_state_of_a_builder_alone_has_no_builder_number() -> None:
    states = agent_of("shared", 1).low_level_states(SEEN[::2], np.array([1, 0]))
    assert states.tolist() == [[7, 14, 11, 1], [0, 0, 4, 0]]


def test_a_single_agents_state_is_its_arenas_observation() -> None:
    seen = np.concatenate((SEEN, np.ones((4, 1), np.int64)), axis=1)
    assert agent_of("single", 2).low_level_states(seen, np.array([1, 0])).tolist() == seen.tolist()


def test_the_main_agent_sees_the_first_builders_start() -> None:
    assert agent_of("shared", 3).start_states([LINE, LINE]).tolist() == [[7, 14, 11]] * 2


def test_builders_share_a_row_or_have_their_own() -> None:
    chosen = np.array([1, 0])
    for networks, rows in (("shared", [[0, 1]] * 3), ("own", [[0, 3], [1, 4], [2, 5]])):
        agent = agent_of(networks, 3)  # type: ignore[arg-type]  # they are two of the three
        assert [agent.low_level_rows(places, chosen).tolist() for places in agent.builders_of(BOTH)] == rows


# 4 inputs alone and 5 with a number; 8 or 10 actions; hidden layers of 32; the main agent has 3 inputs and 2 actions.
MAIN = 4 * 32 + 33 * 32 + 33 * 2
ALONE, NUMBERED, SINGLE = (5 * 32 + 33 * 32 + 33 * 8), (6 * 32 + 33 * 32 + 33 * 8), (5 * 32 + 33 * 32 + 33 * 10)


@pytest.mark.parametrize(
    ("networks", "builders", "count", "parameters"),
    [
        ("shared", 1, 2, MAIN + ALONE),
        ("shared", 4, 2, MAIN + NUMBERED),
        ("own", 4, 5, MAIN + 4 * NUMBERED),
        ("single", 4, 4, 4 * SINGLE),
    ],
)
def test_shared_own_and_single_networks_differ_in_number_and_parameters(
    networks: Networks, builders: int, count: int, parameters: int
) -> None:
    agent = agent_of(networks, builders)
    assert (agent.networks, agent.parameters) == (count, parameters)


def a_tick(agent: Agent, draws: int = 0) -> Step:
    states, chosen = agent.low_level_states(SEEN, np.array([1, 0])), np.array([1, 0])
    done = np.zeros(4, np.int64), np.ones(4), SEEN, chosen, np.zeros(4, np.bool_)
    numbers = np.random.default_rng(0).random((2, draws))
    return Step(BOTH, np.ones(2, np.bool_), SEEN, chosen, states, *done, numbers)


def test_shared_networks_learn_from_all_builders_and_own_networks_from_their_own() -> None:
    shared, own = agent_of("shared", 2), agent_of("own", 2)
    for agent in (shared, own):
        for _ in range(PAPER.update.learning_starts - 1):
            states = agent.low_level_states(SEEN, np.array([1, 0]))
            for places in agent.builders_of(BOTH):
                rows = agent.low_level_rows(places, np.array([1, 0]))
                seen = np.zeros(2, np.int64), np.ones(2), states[places], np.zeros(2, np.bool_)
                agent.low_level.store(rows, states[places], *seen)
        Practice(agent, PAPER).learn(a_tick(agent, draws=2 * PAPER.update.batch))
    ticks = PAPER.update.learning_starts
    assert shared.low_level.replay.added.tolist() == [2 * ticks] * 2
    assert own.low_level.replay.added.tolist() == [ticks] * 4
    assert shared.low_level.engine.updates.tolist() == [2, 2]
    assert own.low_level.engine.updates.tolist() == [1, 1, 1, 1]


@pytest.mark.parametrize(("preset", "table"), [("tuned", "excursions"), ("model-based", "imagination")])
@pytest.mark.parametrize("networks", NETWORKS)
def test_excursions_and_imagination_are_refused_for_several_builders(
    networks: Networks, preset: str, table: str
) -> None:
    with pytest.raises(PresetError, match=rf"^a preset with \[{table}\] is for one agent alone: take paper"):
        agent_of(networks, 2, preset=load_preset(preset))


def test_image_states_are_refused_for_several_builders() -> None:
    with pytest.raises(PresetError, match=r"^several builders see numbers, not states 'image': take the preset"):
        agent_of("shared", 2, preset=load_preset("image"))


@pytest.mark.parametrize("networks", NETWORKS)
def test_greedy_play_repeats_the_trainings_last_evaluation(networks: Networks) -> None:
    trainer = finish(trainer_of(networks, 2))
    for last in [row for row in trainer.evaluation_rows if row.episode == SHORT.episodes]:
        rows = trainer.agent.rows_of(last.trial)
        agent = agent_of(networks, 2, [last.trial], SHORT)
        agent.load_online({role: trainer.policies[role][rows[role]] for role in agent.online()})
        (episode,) = play_greedily(agent.view_of(arenas_of(2, 1), [LINE]), [LINE], agent)
        assert (episode.material, len(episode.actions), episode.score) == (last.material, last.steps, last.score)
        assert trainer.policy_scores[last.trial] == last.score


def test_networks_of_another_shape_are_refused() -> None:
    agent = trainer_of("shared", 2).agent
    with pytest.raises(ValueError, match="networks of"):
        agent.load_online({role: np.zeros((1, 3), np.float32) for role in agent.online()})


MORE = SHORT.model_copy(
    update={
        "episodes": 10,
        "encoding": "one-hot",
        "updates_a_step": 2,
        "keep": "best",
        "main": MainUpdates(learning_starts=2, updates_an_episode=3),
        "prioritized": Prioritized(alpha=0.6, beta=0.4),
    }
)


def papers(agent: str, preset: Preset) -> Trainer:
    spec, scenarios = AGENT_SPECS[agent], [LINE, LINE]
    theirs = Agent(spec, scenarios, preset, 3)
    return finish(Trainer(theirs.view_of(GridVectorEnv(scenarios), scenarios), scenarios, theirs, preset, 3))


def rows_of(trainer: Trainer, trial: int) -> list[tuple[float, ...]]:
    played = [row[1:] for row in trainer.episode_rows if row.trial == trial]
    return [*played, *(row[1:] for row in trainer.evaluation_rows if row.trial == trial)]


@pytest.mark.parametrize("preset", [SHORT, MORE], ids=["paper", "more"])
@pytest.mark.parametrize(("networks", "agent"), [("shared", "nested"), ("own", "nested"), ("single", "single")])
def test_a_builder_alone_learns_what_the_papers_agent_learns_to_the_bit(
    networks: Networks, agent: str, preset: Preset
) -> None:
    ours, theirs = finish(trainer_of(networks, 1, preset=preset, seed=3)), papers(agent, preset)
    assert ours.episode_rows == theirs.episode_rows
    assert ours.evaluation_rows == theirs.evaluation_rows
    np.testing.assert_array_equal(ours.agent.low_level.engine.online, theirs.agent.low_level.engine.online)
    np.testing.assert_array_equal(ours.policy_scores, theirs.policy_scores)
    assert ours.env_steps == theirs.env_steps


@pytest.mark.parametrize("builders", [2, 3])
@pytest.mark.parametrize("networks", NETWORKS)
def test_a_run_learns_the_same_alone_and_beside_others(networks: Networks, builders: int) -> None:
    together = finish(trainer_of(networks, builders, runs=(0, 1)))
    alone = finish(trainer_of(networks, builders, runs=(1,)))
    assert rows_of(together, 1) == rows_of(alone, 0)
    rows = together.agent.rows_of(1)["low"]
    np.testing.assert_array_equal(together.agent.low_level.engine.online[rows], alone.agent.low_level.engine.online)


@pytest.mark.parametrize("preset", [SHORT, MORE], ids=["paper", "more"])
@pytest.mark.parametrize("networks", NETWORKS)
def test_a_resumed_training_continues_to_the_bit(networks: Networks, preset: Preset) -> None:
    whole, first, second = (trainer_of(networks, 2, preset=preset) for _ in range(3))
    second.load(*saved(ticked(first, 333)))
    assert_same(finish(second), finish(whole))


def test_another_seed_gives_another_training() -> None:
    one, other = finish(trainer_of("shared", 2, seed=0)), finish(trainer_of("shared", 2, seed=1))
    assert one.episode_rows != other.episode_rows


def test_evaluations_come_every_5_episodes_and_train_nothing() -> None:
    trainer = finish(trainer_of("shared", 3))
    episodes = [row.episode for row in trainer.evaluation_rows if row.trial == 0]
    assert episodes == [5, 10, 15, 20]
    assert trainer.env_steps == sum(row.steps for row in trainer.episode_rows)
    assert trainer.evaluation_steps == sum(row.steps for row in trainer.evaluation_rows)
    of_trials = [sum(row.steps for row in trainer.episode_rows if row.trial == trial) for trial in (0, 1)]
    assert trainer.agent.low_level.replay.added.tolist() == [3 * steps for steps in of_trials]


def test_epsilon_falls_with_the_episodes_as_for_one_builder() -> None:
    trainer = finish(trainer_of("shared", 2))
    first, last = trainer.episode_rows[0], trainer.episode_rows[-1]
    assert (first.epsilon_main, first.epsilon_nested) == (1.0, 1.0)
    assert last.epsilon_main == pytest.approx(0.01)
    assert last.epsilon_nested == pytest.approx(0.001)
