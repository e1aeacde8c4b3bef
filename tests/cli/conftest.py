"""Trainings that several verbs are tried on."""

import socket
from pathlib import Path

import pytest
import tomlkit

import sim.worlds
from mc_nested.arena.scenario import Scenario
from mc_nested.workers.cluster import connection
from tests.arena.made_games import TakesAtItsWord
from tests.cli.running import TRAIN, run
from tests.learn.objectives.made_objectives import small


@pytest.fixture(scope="session")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "run"
    assert run(*TRAIN, "--out", out) == 0
    return out


@pytest.fixture
def opened_games(monkeypatch: pytest.MonkeyPatch) -> list[TakesAtItsWord]:
    """Return the simulator's games that are opened from here on; each wants what was announced."""
    games: list[TakesAtItsWord] = []

    def opened(scenario: Scenario) -> TakesAtItsWord:
        games.append(TakesAtItsWord(scenario))
        return games[-1]

    monkeypatch.setattr(sim.worlds, "GridGame", opened)
    return games


@pytest.fixture
def nobodys_port(monkeypatch: pytest.MonkeyPatch) -> str:
    """Return a port of this machine where no scheduler answers, which is soon given up."""
    monkeypatch.setattr(connection, "CONNECT_S", 0.5)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return str(free.getsockname()[1])


@pytest.fixture(scope="session")
def optimal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a training that has reached the optimum on the line."""
    out = tmp_path_factory.mktemp("runs") / "optimal"
    assert (
        run("train", "--preset", "model-based", "--stop-at-optimum", "--trials", "2", "--seed", "4", "--out", out) == 0
    )
    return out


@pytest.fixture(scope="session")
def with_objectives(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a training of the agent with objectives, which has learnt next to nothing."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "small.toml").write_text(tomlkit.dumps(small().model_dump(exclude_none=True)), "utf-8")
    assert run("train", "--preset", folder / "small.toml", "--out", folder / "run") == 0
    return folder / "run"
