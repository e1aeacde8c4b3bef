"""The backend "virtual": the live path on virtual clients, one for each trial, from the command line."""

import json
import signal
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.builder import build
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli.interrupt import INTERRUPTED
from mc_nested.learn.trainer import Trainer
from mc_nested.live.session import Opening
from sim.client.client import VirtualClient
from sim.virtual_games import VirtualPlay, built_arena, open_virtual_games
from sim.worlds import Backend, open_arenas, open_game, where_words
from tests.cli.running import run

LINE = load_scenario("line")
SMALL = Scenario("small", frozenset({(2, 2)}), (2, 0), 5, (Material("stone", 1.0, "stone"),), 5)


def test_a_scenario_is_built_on_the_virtual_backend_by_reading_its_window() -> None:
    with open_game(Backend.VIRTUAL, LINE, Opening("none", print)) as (game, display):
        assert display is not None
        assert display.size() == (854, 480)
        env = ArenaEnv(game, LINE)
        env.reset(options={"material": "stone"})
        for action in build(LINE):
            _, _, _, _, info = env.step(action)
    assert info["score"] == LINE.optimum


def test_each_virtual_arena_is_a_separate_game_and_the_log_has_its_game_time() -> None:
    with open_arenas(Backend.VIRTUAL, [SMALL, SMALL], Opening("none", print), seed=1) as (env, log):
        assert env.num_envs == 2
        assert isinstance(log, VirtualPlay)
        env.reset(options={"reset_mask": np.array([True, False])})
        first, second = log.game_s
        assert 0.5 < first < 3.0
        assert second == 0
        summary = log.summary()
    assert summary["game_s"] == [round(first, 3), 0]
    assert [each["actions"] for each in summary["games"]] == [0, 0]


def test_the_arenas_cells_and_its_surroundings_have_floors_of_different_blocks() -> None:
    world = VirtualClient().realm.world
    arena = built_arena(world, SMALL)
    below = arena.origin[1] - 1

    def floor(cell: tuple[int, int]) -> str:
        block = arena.block_of(cell)
        return world.block_at((block[0], below, block[2]))

    assert {floor((right, forward)) for right in range(5) for forward in range(5)} == {"obsidian"}
    assert {floor((-1, 0)), floor((5, 0)), floor((0, 5)), floor((15, 15))} == {"lapis_block"}
    assert world.block_at(arena.block_of((5, 5))) == "air"
    assert world.block_at(arena.block_of((-1, 7))) == "lapis_block"


def test_trials_and_seeds_have_different_latencies() -> None:
    with open_virtual_games([SMALL, SMALL], seed=0) as games, open_virtual_games([SMALL], seed=1) as others:
        times = []
        for game in (*games, *others):
            game.reset(0)
            times.append(game.connection.devices.clock.now())
    assert len(set(times)) == 3


def test_the_virtual_backend_is_named_in_words() -> None:
    assert where_words(Backend.VIRTUAL) == "on the virtual client"


@pytest.mark.slow
def test_a_training_on_the_virtual_backend_can_be_resumed_and_reports_game_time(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "run"
    tick = Trainer.tick
    ticks = 0

    def tick_until_stopped(trainer: Trainer) -> None:
        nonlocal ticks
        ticks += 1
        if ticks == 70:
            signal.raise_signal(signal.SIGINT)
        tick(trainer)

    monkeypatch.setattr(Trainer, "tick", tick_until_stopped)
    words = ["--backend", "virtual", "--trials", "2", "--episodes", "3"]
    assert run("train", *words, "--out", folder) == INTERRUPTED
    assert 'backend = "virtual"' in (folder / "config.toml").read_text("utf-8")
    assert run("train", "--resume", folder) == 0
    assert "minutes on the virtual client" in capsys.readouterr().out
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    assert summary["episodes_done"] == [3, 3]
    assert len(summary["live"]["game_s"]) == 2
    assert min(summary["live"]["game_s"]) > 10
