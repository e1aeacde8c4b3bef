"""A training whose game cannot wait: which episodes are played before practice is over, and what errors leave."""

import threading
from collections.abc import Callable

import numpy as np
import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Resumable
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Arrays
from mc_nested.errors import LiveError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.background_practice import Background, BackgroundThread, GoesOn
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridGame, GridVectorEnv
from tests.arena.made_games import TakesAtItsWord
from tests.learn.made_trainings import StartsOver, copied, finish

LINE = load_scenario("line")
LIVE = load_preset("model-based").model_copy(update={"episodes": 5})
PATIENCE_S = 20.0


class Slow(StartsOver):
    """A game that can't be saved half-way. It fails once at an action, and where it is told to at a reset."""

    error = LiveError("the game is gone")
    at_reset: Callable[[], None] = staticmethod(lambda: None)

    def reset(self, material: int) -> Cell:
        self.at_reset()
        return super().reset(material)


class Rounds:
    """A background whose work is done at its end: that many rounds of it beside a reset, and beside an episode."""

    def __init__(self, beside_reset: int, beside_episode: int = 0) -> None:
        self._beside_reset, self._beside_episode = beside_reset, beside_episode
        self._work: Callable[[GoesOn], None] | None = None

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        self._work = work

    def end(self, longer_s: float = 0.0) -> None:
        if self._work:
            left = iter(range(self._beside_reset if longer_s else self._beside_episode))
            self._work(lambda: next(left, None) is not None)
            self._work = None


class PutsIn(Rounds):
    """A background that calls a function before its work begins."""

    def __init__(self, before: Callable[[], None]) -> None:
        super().__init__(0)
        self._before = before

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        self._before()
        super().begin(work)


ENOUGH = 1_000


def training(background: Background | None = None, game: GridGame | None = None) -> Trainer:
    env = ArenaVectorEnv([ArenaEnv(game or Slow(LINE), LINE)])
    return Trainer(env, [LINE], Agent(AGENT_SPECS["nested"], [LINE], LIVE, 0), LIVE, 0, background=background)


def networks(trainer: Trainer) -> Arrays:
    return copied(trainer.agent.state())


def are_the_same(one: Arrays, other: Arrays) -> bool:
    return all(np.array_equal(one[name], other[name]) for name in one)


def test_a_live_training_with_enough_practice_time_plays_the_simulators_episodes() -> None:
    agent = Agent(AGENT_SPECS["nested"], [LINE], LIVE, 0)
    simulated = finish(Trainer(GridVectorEnv([LINE]), [LINE], agent, LIVE, 0))
    beside = finish(training(Rounds(ENOUGH)))
    assert beside.episode_rows == simulated.episode_rows
    assert beside.evaluation_rows == simulated.evaluation_rows
    assert are_the_same(networks(beside), networks(simulated))


def test_an_episode_that_begins_before_practice_is_over_is_a_training_episode() -> None:
    trainer = finish(training(Rounds(0)))
    assert [row.episode for row in trainer.episode_rows] == [1, 2, 3, 4, 5]
    assert [row.episode for row in trainer.evaluation_rows] == [5], "after the last episode there is always one"
    assert trainer.agent.low_level.engine.updates.tolist() == [0]


def test_networks_practised_during_an_episode_are_taken_over_before_the_next_reset() -> None:
    trainer = training(Rounds(0, beside_episode=ENOUGH))
    while len(trainer.episode_rows) < 2:
        trainer.tick()
        assert trainer.agent.low_level.engine.updates.tolist() == [0]
    trainer.tick()
    assert trainer.agent.low_level.engine.updates[0] > 0


class Live(TakesAtItsWord):
    """A game that can't be saved half-way, and that takes whoever plays it at their word."""

    @property
    def resumable(self) -> Resumable | None:
        return None


class Hasty(BackgroundThread):
    """Waits for hardly any practice; what isn't over goes on beside the episode."""

    def end(self, longer_s: float = 0.0) -> None:
        super().end(longer_s / 100)


@pytest.mark.parametrize("background", [Rounds(3, beside_episode=ENOUGH), Hasty()], ids=["rounds", "thread"])
def test_practice_beside_an_episode_changes_nothing_that_was_announced_in_it(background: Background) -> None:
    game = Live(LINE)
    trainer = finish(training(background, game))
    assert game.acts == trainer.env_steps + trainer.evaluation_steps
    assert game.kept > game.acts / 2


def test_a_failed_reset_ends_the_practice_and_the_training_goes_on() -> None:
    game = Slow(LINE)
    trainer = training(game=game)
    while not trainer.episode_rows:
        trainer.tick()

    def fails() -> None:
        raise LiveError("no world")

    game.at_reset = fails
    with pytest.raises(LiveError, match="no world"):
        trainer.tick()
    assert "practice" not in [thread.name for thread in threading.enumerate()]
    trainer.abandon_episodes()
    game.at_reset = lambda: None
    assert [row.episode for row in finish(trainer).episode_rows] == [1, 2, 3, 4, 5]


def test_practice_runs_in_a_thread_while_the_game_resets() -> None:
    game, updates = Slow(LINE), 0
    trainer = training(game=game)
    while not trainer.episode_rows:
        trainer.tick()

    def waits_for_practice() -> None:
        nonlocal updates
        pause = threading.Event()
        for _ in range(int(PATIENCE_S / 0.01)):
            if updates := int(trainer.agent.low_level.engine.updates[0]):
                return
            pause.wait(0.01)

    game.at_reset = waits_for_practice
    trainer.tick()
    assert updates > 0


def test_abandoning_an_episode_restores_the_networks_put_in_to_play_the_episode() -> None:
    begun = 0

    def best_are_put_in() -> None:
        nonlocal begun
        begun += 1
        trainer.agent.low_level.engine.online[:] = begun

    game = Slow(LINE)
    trainer = training(PutsIn(best_are_put_in), game)
    while not trainer.episode_rows:
        trainer.tick()
    before = begun
    game.acts_left = 2
    with pytest.raises(LiveError):
        finish(trainer)
    assert begun == before + 2, "beside the reset and beside the episode"
    trainer.agent.low_level.engine.online[:] = 0.0
    trainer.abandon_episodes()
    assert np.all(trainer.agent.low_level.engine.online == begun)


def test_an_abandoned_episode_keeps_earlier_practice_and_nothing_of_its_own_steps() -> None:
    game = Slow(LINE)
    trainer = training(Rounds(2, beside_episode=1), game)
    while len(trainer.episode_rows) < 2:
        trainer.tick()
    trainer.tick()
    practised, known = networks(trainer), len(trainer.state()["practice.0.steps"]) - 1
    game.acts_left = 10
    with pytest.raises(LiveError):
        finish(trainer)
    trainer.abandon_episodes()
    assert are_the_same(networks(trainer), practised)
    assert len(trainer.state()["practice.0.steps"]) == known
    before = int(trainer.agent.low_level.engine.updates[0])
    assert before > 0
    assert [row.episode for row in finish(trainer).episode_rows] == [1, 2, 3, 4, 5]
    assert trainer.agent.low_level.engine.updates[0] >= before
