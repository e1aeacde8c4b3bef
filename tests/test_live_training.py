"""A training through the live path, on the virtual client: as in the simulator, and resumed from a saved state."""

import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import LiveError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.live.live_game import LiveGame
from sim.client.client import VirtualClient
from sim.grid import GridVectorEnv
from tests.sim.client.playing import play

LINE = load_scenario("line")
EPISODES = 8


def _trainer(env: ArenaVectorEnv | GridVectorEnv, episodes: int = EPISODES) -> Trainer:
    preset = load_preset("paper").model_copy(update={"episodes": episodes})
    return Trainer(env, [LINE], Agent(AGENT_SPECS["nested"], [LINE], preset, 3), preset, 3)


def _live(game: LiveGame) -> ArenaVectorEnv:
    return ArenaVectorEnv([ArenaEnv(game, LINE)])


def _rows(trainer: Trainer) -> list[EpisodeRow]:
    while not trainer.finished:
        trainer.tick()
    return trainer.episode_rows


@pytest.mark.slow
def test_live_episodes_have_the_simulators_steps_and_scores() -> None:
    client = VirtualClient(seed=5)
    with play(client, LINE) as game:
        live = _rows(_trainer(_live(game)))
    assert live == _rows(_trainer(GridVectorEnv([LINE])))
    assert len(live) == EPISODES


@pytest.mark.slow
def test_a_resumed_live_training_goes_on_at_the_next_episode() -> None:
    with play(VirtualClient(seed=6), LINE) as game:
        first = _trainer(_live(game))
        while len(first.episode_rows) < 2 or not first.env_steps % 7:
            first.tick()
        state, journal = first.state(), first.journal(None)
    client = VirtualClient(seed=7)
    with play(client, LINE) as game:
        second = _trainer(_live(game))
        second.load(state, [journal])
        rows = _rows(second)
    assert rows[:2] == first.episode_rows
    assert [row.episode for row in rows] == list(range(1, EPISODES + 1))


@pytest.mark.slow
def test_a_live_training_drops_episodes_with_mishaps_and_finishes() -> None:
    client = VirtualClient(seed=8)
    client.mishaps.every(0.15)
    failures = 0
    with play(client, LINE) as game:
        trainer = _trainer(_live(game), episodes=4)
        while not trainer.finished:
            try:
                trainer.tick()
            except LiveError:  # noqa: PERF203 - each tick may fail
                failures += 1
                trainer.abandon_episodes()
        assert game.log.failed_actions <= failures
    assert failures > 0
    assert [row.episode for row in trainer.episode_rows] == [1, 2, 3, 4]
    assert client.window.down == set()
    assert client.window.strays == []
