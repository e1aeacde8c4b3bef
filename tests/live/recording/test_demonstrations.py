"""The episodes in a recording, as an agent learns from them."""

from pathlib import Path

import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.demonstrations import demonstrations_in
from scripts.benches.person import clumsy
from scripts.benches.teach import NEEDLESS, WRONG, record_a_build
from tests.live.recording.recorded_play import record_play

DIAMOND = load_scenario("diamond")


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the recording of a diamond that a person who had taken over built clumsily."""
    folder = tmp_path_factory.mktemp("shown") / "recording"
    record_a_build(folder, DIAMOND, clumsy(DIAMOND, 0, NEEDLESS, WRONG), 0)
    return folder


def test_a_build_by_hand_is_one_episode_of_what_the_person_did(recording: Path) -> None:
    (shown,), said = demonstrations_in(recording, DIAMOND)
    assert said == f"{recording}: 1 whole episode to learn from"
    cell, placed = DIAMOND.start, set[Cell]()
    for (action, material), outcome in shown.steps:
        assert material is None
        cell = moved(cell, action, placed, DIAMOND.size)
        assert (outcome.cell, outcome.placed) == (cell, landing(cell, action, placed, DIAMOND.size))
        placed |= {outcome.placed} if outcome.placed else set()
    assert 0 < len(placed - DIAMOND.design) <= WRONG
    assert len(placed) == DIAMOND.blocks or len(shown.steps) == DIAMOND.step_limit


def test_a_recording_of_another_design_is_refused(recording: Path) -> None:
    with pytest.raises(RecordingError, match=r"was recorded with diamond, .* aren't those of line"):
        demonstrations_in(recording, load_scenario("line"))


def test_a_recording_without_a_whole_episode_is_refused(tmp_path: Path) -> None:
    record_play(tmp_path / "play", 5)
    with pytest.raises(RecordingError, match="holds no whole episode: build until no block is left"):
        demonstrations_in(tmp_path / "play", DIAMOND)
