"""Trainings that several verbs are tried on."""

from pathlib import Path

import pytest

from tests.cli.running import TRAIN, run


@pytest.fixture(scope="session")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "run"
    assert run(*TRAIN, "--out", out) == 0
    return out


@pytest.fixture(scope="session")
def optimal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a training that has reached the optimum on the line."""
    out = tmp_path_factory.mktemp("runs") / "optimal"
    assert (
        run("train", "--preset", "model-based", "--stop-at-optimum", "--trials", "2", "--seed", "4", "--out", out) == 0
    )
    return out
