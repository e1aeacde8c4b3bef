"""Recordings that several test files read."""

from pathlib import Path

import pytest

from tests.live.recording.recorded_play import record_play


@pytest.fixture(scope="session")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of two episodes: of 25 actions, and of 5."""
    folder = tmp_path_factory.mktemp("fresh") / "play"
    assert record_play(folder, 30, seed=5, is_told=True) == []
    return folder
