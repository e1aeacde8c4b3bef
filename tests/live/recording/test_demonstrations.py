"""The episodes in a recording, as an agent learns from them."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.demonstrations import RecordedPlay, demonstrations_in, played_in
from mc_nested.live.recording.recording_file import PartWriter, TimedCall, facts_of, read_recording
from scripts.benches.person import clumsy
from scripts.benches.teach import NEEDLESS, WRONG, record_a_build
from tests.live.recording.recorded_play import record_play, timed
from tests.recordings.test_recordings import VIRTUAL

KEPT = sorted(VIRTUAL.glob("*.mcap"))
LINE = VIRTUAL / "rehearsal-window.mcap"
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
    for action, material, outcome, _ in shown.steps:
        assert material == shown.material
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


def calls_of(path: Path) -> list[tuple[int, list[Any]]]:
    return [(each.at, each.call) for each in read_recording(path) if isinstance(each, TimedCall)]


def notes(path: Path, kind: str) -> list[dict[str, Any]]:
    return [call[2] for _, call in timed(path) if call[:2] == ["note", kind]]


def write(path: Path, facts: Mapping[str, str], calls: list[tuple[int, list[Any]]]) -> None:
    writer = PartWriter(path, facts)
    for at in range(0, len(calls), 100):
        writer.write([TimedCall(*each) for each in calls[at : at + 100]])
    writer.close()


def steps_told(played: RecordedPlay) -> list[tuple[int, list[int], list[int] | None]]:
    return [
        (int(step.action), list(step.outcome.cell), step.outcome.placed and list(step.outcome.placed))
        for episode in played.episodes
        for step in episode.steps
    ]


def steps_noted(path: Path) -> list[tuple[int, list[int], list[int] | None]]:
    both = zip(notes(path, "acts"), notes(path, "done"), strict=True)
    return [(done.get("instead", acts["action"]), done["cell"], done["placed"]) for acts, done in both]


@pytest.mark.parametrize("path", KEPT, ids=lambda path: path.stem)
def test_steps_of_a_kept_recording_are_those_that_its_journal_confirmed(path: Path) -> None:
    assert steps_told(played_in(path)) == steps_noted(path)


def test_episodes_have_their_actions_and_the_material_in_hand(fresh: Path) -> None:
    played = played_in(fresh)
    assert steps_told(played) == steps_noted(fresh)
    assert [(len(episode.steps), episode.is_whole) for episode in played.episodes] == [(25, False), (5, False)]
    assert (played.left_out, played.damage) == (0, [])
    for material, episode in enumerate(played.episodes):
        assert {episode.material, *(step.material for step in episode.steps)} == {material}


def test_an_episode_that_is_built_is_whole() -> None:
    assert [episode.is_whole for episode in played_in(LINE).episodes] == [True]


def test_an_action_that_a_player_did_instead_is_the_steps(tmp_path: Path) -> None:
    record_play(tmp_path / "play", 20, seed=3, switches=(2.0, 6.0))
    instead = [done["instead"] for done in notes(tmp_path / "play", "done") if "instead" in done]
    assert instead
    assert steps_told(played_in(tmp_path / "play")) == steps_noted(tmp_path / "play")


def test_actions_behind_an_episodes_end_are_left_out(fresh: Path, tmp_path: Path) -> None:
    """Random play knows of no step limit: here one of 20 steps."""
    facts = facts_of(fresh)
    limited = re.sub(r"step_limit = \d+", "step_limit = 20", facts["scenario"])
    write(tmp_path / "limited.mcap", {**facts, "scenario": limited}, calls_of(fresh))
    played = played_in(tmp_path / "limited.mcap")
    assert [len(episode.steps) for episode in played.episodes] == [20, 5]
    assert [episode.is_whole for episode in played.episodes] == [True, False]
    assert played.left_out == 5


def test_recording_that_breaks_off_is_told_up_to_there(fresh: Path, tmp_path: Path) -> None:
    write(tmp_path / "whole.mcap", facts_of(fresh), calls_of(fresh))
    whole = (tmp_path / "whole.mcap").read_bytes()
    (tmp_path / "torn.mcap").write_bytes(whole[: len(whole) // 2])
    played = played_in(tmp_path / "torn.mcap")
    told = steps_told(played)
    assert 0 < len(told) < 30
    assert told == steps_noted(fresh)[: len(told)]
    assert played.damage == ["torn.mcap: it ends early, as after a crash"]
    assert played.left_out <= 1


def test_actions_behind_a_lost_part_are_left_out_until_the_next_reset(fresh: Path, tmp_path: Path) -> None:
    calls = calls_of(fresh)
    begins = [at for at, (_, call) in enumerate(calls) if call[:2] == ["note", "acts"]]
    (tmp_path / "parts").mkdir()
    write(tmp_path / "whole.mcap", facts_of(fresh), calls[: begins[15]])
    (tmp_path / "parts" / "00001.mcap").write_bytes((tmp_path / "whole.mcap").read_bytes()[:-5000])
    write(tmp_path / "parts" / "00002.mcap", facts_of(fresh), calls[begins[20] :])
    played = played_in(tmp_path / "parts")
    first, second = (len(episode.steps) for episode in played.episodes)
    assert (second, steps_told(played)) == (5, [*steps_noted(fresh)[:first], *steps_noted(fresh)[25:]])
    assert played.left_out >= 5


@pytest.mark.parametrize(
    ("facts", "calls", "why"),
    [
        ({}, [["now", 1.0]], "no action was confirmed in it"),
        ({"scenario": None}, [["now", 1.0]], "names no design"),
    ],
)
def test_recording_without_actions_or_design_is_refused(
    facts: dict[str, str | None], calls: list[list[Any]], why: str, tmp_path: Path
) -> None:
    said = {name: text for name, text in {**facts_of(LINE), **facts}.items() if text is not None}
    write(tmp_path / "one.mcap", said, [(1, call) for call in calls])
    with pytest.raises(RecordingError, match=why):
        played_in(tmp_path / "one.mcap")


@pytest.mark.parametrize(
    ("kind", "change", "why"),
    [
        ("done", {"cell": [99, 0]}, r"leaves the arena at \(99, 0\)"),
        ("done", {"cell": [3]}, "its notes are damaged"),
        ("resets", {}, "its notes are damaged"),
    ],
)
def test_recording_whose_notes_cannot_be_is_refused(
    kind: str, change: dict[str, Any], why: str, fresh: Path, tmp_path: Path
) -> None:
    calls = [(at, [*call[:2], change] if call[:2] == ["note", kind] else call) for at, call in calls_of(fresh)]
    write(tmp_path / "one.mcap", facts_of(fresh), calls)
    with pytest.raises(RecordingError, match=why):
        played_in(tmp_path / "one.mcap")
