"""Training a team: alone it is the paper's agent, it repeats to the bit, and it goes on from a save to the bit."""

import numpy as np
import pytest

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.cooperation.team_agent import KINDS, Kind
from mc_nested.learn.cooperation.team_trainer import TeamTrainer
from mc_nested.learn.preset import MainUpdates, Preset, Prioritized
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.cooperation.teams import LINE, SHORT, finish, trainer_of

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
    trainer = Trainer(theirs.view_of(GridVectorEnv(scenarios), scenarios), scenarios, theirs, preset, 3)
    while not trainer.finished:
        trainer.tick()
    return trainer


def rows_of(trainer: TeamTrainer, trial: int) -> list[tuple[float, ...]]:
    played = [row[1:] for row in trainer.episode_rows if row.trial == trial]
    return [*played, *(row[1:] for row in trainer.evaluation_rows if row.trial == trial)]


@pytest.mark.parametrize("preset", [SHORT, MORE], ids=["paper", "more"])
@pytest.mark.parametrize(("kind", "agent"), [("shared", "nested"), ("own", "nested"), ("single", "single")])
def test_a_builder_alone_learns_what_the_papers_agent_learns_to_the_bit(kind: Kind, agent: str, preset: Preset) -> None:
    ours, theirs = finish(trainer_of(kind, 1, preset=preset, seed=3)), papers(agent, preset)
    assert ours.episode_rows == theirs.episode_rows
    assert ours.evaluation_rows == theirs.evaluation_rows
    np.testing.assert_array_equal(ours.agent.builders.engine.online, theirs.agent.low_level.engine.online)
    np.testing.assert_array_equal(ours.kept_scores, theirs.kept_scores)
    assert ours.env_ticks == theirs.env_steps


@pytest.mark.parametrize("builders", [2, 3])
@pytest.mark.parametrize("kind", KINDS)
def test_a_run_learns_the_same_alone_and_beside_others(kind: Kind, builders: int) -> None:
    together = finish(trainer_of(kind, builders, runs=(0, 1)))
    alone = finish(trainer_of(kind, builders, runs=(1,)))
    assert rows_of(together, 1) == rows_of(alone, 0)
    rows = together.agent.rows_of(1)["builders"]
    np.testing.assert_array_equal(together.agent.builders.engine.online[rows], alone.agent.builders.engine.online)


@pytest.mark.parametrize("preset", [SHORT, MORE], ids=["paper", "more"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_training_goes_on_from_a_save_to_the_bit(kind: Kind, preset: Preset) -> None:
    whole, first, second = (trainer_of(kind, 2, preset=preset) for _ in range(3))
    for _ in range(333):
        first.tick()
    kept, journal = {name: each.copy() for name, each in first.state().items()}, first.journal(None)
    second.load(kept, [journal])
    finish(whole), finish(second)
    assert whole.episode_rows == second.episode_rows
    assert whole.evaluation_rows == second.evaluation_rows
    for name, each in whole.state().items():
        np.testing.assert_array_equal(each, second.state()[name], err_msg=name)


def test_the_journal_holds_what_came_since_the_marks() -> None:
    trainer, other = trainer_of("own", 2), trainer_of("own", 2)
    first = trainer.journal(None)
    marks = trainer.marks()
    for _ in range(200):
        trainer.tick()
    other.load(trainer.state(), [first, trainer.journal(marks)])
    finish(trainer), finish(other)
    assert trainer.evaluation_rows == other.evaluation_rows


def test_another_seed_is_another_training() -> None:
    one, other = finish(trainer_of("shared", 2, seed=0)), finish(trainer_of("shared", 2, seed=1))
    assert one.episode_rows != other.episode_rows


def test_evaluations_come_every_so_many_episodes_and_are_no_training() -> None:
    trainer = finish(trainer_of("shared", 3))
    episodes = [row.episode for row in trainer.evaluation_rows if row.trial == 0]
    assert episodes == [5, 10, 15, 20]
    assert trainer.env_ticks == sum(row.steps for row in trainer.episode_rows)
    assert trainer.evaluation_ticks == sum(row.steps for row in trainer.evaluation_rows)
    assert (
        trainer.agent.builders.replay.added
        == [3 * sum(r.steps for r in trainer.episode_rows if r.trial == t) for t in (0, 1)]
    ).all()


def test_epsilon_falls_with_the_episodes_as_for_one_builder() -> None:
    trainer = finish(trainer_of("shared", 2))
    first, last = trainer.episode_rows[0], trainer.episode_rows[-1]
    assert (first.epsilon_main, first.epsilon_nested) == (1.0, 1.0)
    assert last.epsilon_main == pytest.approx(0.01)
    assert last.epsilon_nested == pytest.approx(0.001)
