"""What is told of a recording's play is what its calls say, each taken from them here in the plainest way."""

import re
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording import call_encoder
from mc_nested.live.recording.cut import cut
from mc_nested.live.recording.frames import Played, PlayedFrame, frames_of, played_in
from mc_nested.live.recording.recording_file import PartWriter, TimedCall, facts_of, overview_of, read_recording
from mc_nested.live.recording.text_pixels import OUTSIDE
from mc_nested.live.vision.chat_region import BLANK, chat_regions
from mc_nested.live.vision.layout import largest_gui_scale
from sim.client.client import VirtualClient
from tests.live.recording.recorded_play import record_play
from tests.recordings.test_recordings import VIRTUAL

KEPT = sorted(VIRTUAL.glob("*.mcap"))
LINE = VIRTUAL / "rehearsal-window.mcap"


@pytest.fixture(scope="module")
def fresh(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of two episodes: of 25 actions, and of 5."""
    folder = tmp_path_factory.mktemp("fresh") / "play"
    assert record_play(folder, 30, seed=5, is_told=True) == []
    return folder


def timed(path: Path) -> Iterator[tuple[float, list[Any]]]:
    """Return a recording's calls, each at the last time that its clock had told."""
    now = 0.0
    for each in read_recording(path):
        if isinstance(each, TimedCall):
            now = each.call[1] if each.call[0] in ("now", "sleep") else now
            yield now, each.call


def calls_of(path: Path) -> list[tuple[int, list[Any]]]:
    return [(each.at, each.call) for each in read_recording(path) if isinstance(each, TimedCall)]


def notes(path: Path, kind: str) -> list[dict[str, Any]]:
    return [call[2] for _, call in timed(path) if call[:2] == ["note", kind]]


def steps_told(played: Played) -> list[tuple[int, list[int], list[int] | None]]:
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


def test_transitions_are_those_of_the_env(fresh: Path) -> None:
    played = played_in(fresh)
    assert steps_told(played) == steps_noted(fresh)
    assert [len(episode.steps) for episode in played.episodes] == [25, 5]
    assert (played.left_out, played.damage) == (0, [])
    design = load_scenario("diamond")
    for episode, material in zip(played.episodes, ("wood", "stone"), strict=True):
        laid: set[tuple[int, int]] = set()
        assert episode.observation.tolist() == [*design.start, design.blocks]
        for step in episode.steps:
            laid |= {step.outcome.placed} if step.outcome.placed else set()
            assert step.observation.tolist() == [*step.outcome.cell, design.blocks - len(laid)]
            assert step.reward == (step.outcome.placed in design.design)
            assert (step.terminated, step.truncated, step.info["material"]) == (False, False, material)


def test_an_episode_that_is_built_ends_and_has_its_score() -> None:
    last = played_in(LINE).episodes[-1].steps[-1]
    assert (last.terminated, last.truncated, last.info["score"]) == (True, False, 21.0)


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
    assert played.episodes[0].steps[-1].truncated
    assert played.left_out == 5


def write(path: Path, facts: Mapping[str, str], calls: list[tuple[int, list[Any]]]) -> None:
    writer = PartWriter(path, facts)
    for at in range(0, len(calls), 100):
        writer.write(calls[at : at + 100], [], [])
    writer.close()


def test_every_call_is_in_the_frame_of_its_time(fresh: Path) -> None:
    played, fps = played_in(fresh), 20
    frames = list(frames_of(played, fps))
    for number, episode in enumerate(played.episodes):
        own = [frame for frame in frames if frame.episode == number]
        ends = [episode.began + (at + 1) / fps for at in range(len(own) - 1)] + [episode.steps[-1].ended]
        assert len(own) == np.ceil((episode.steps[-1].ended - episode.began) * fps - 1e-9)
        check_frames(own, [episode.began + at / fps for at in range(len(own))], ends, fresh)


def holds_in(path: Path) -> list[tuple[str, float, float]]:
    """Return when which key or button went down and up."""
    began: dict[str, float] = {}
    holds = []
    for now, (name, *said) in timed(path):
        if name in ("key", "mouse") and said[0] in ("press", "release"):
            key = said[1] if name == "key" else f"mouse.{said[1]}"
            if said[0] == "press":
                began.setdefault(key, now)
            elif key in began:
                holds.append((key, began.pop(key), now))
    return holds


def check_frames(frames: list[PlayedFrame], begins: list[float], ends: list[float], path: Path) -> None:
    """Check keys and poses by all that is recorded, from the beginning, for each frame."""
    calls, holds = list(timed(path)), holds_in(path)
    for frame, begin, end in zip(frames, begins, ends, strict=True):
        pose: dict[str, Any] = {}
        for now, (name, *said) in calls:
            if name == "screen" and said[0] in ("read", "read_position") and said[2] and now <= begin:
                pose |= said[2] if said[0] == "read" else {"xyz": said[2]}
        assert frame.held == {key for key, press, release in holds if press <= end and release > begin}
        assert frame.pose == (*pose["xyz"], pose["yaw"], pose["pitch"])
        assert frame.step.ended > begin


def test_frames_show_what_was_read_on_grey() -> None:
    frames = list(frames_of(played_in(LINE), 20))
    assert {frame.picture.shape for frame in frames} == {(480, 854, 3)}
    grey = [np.mean((frame.picture == BLANK).all(axis=2)) for frame in frames]
    assert 0.9 < min(grey) <= max(grey) < 1


@pytest.mark.parametrize("size", [(854, 480), (1280, 720)])
def test_chat_is_on_no_frame_though_its_pictures_are(
    size: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every picture is kept here, and somebody says something every two seconds."""
    monkeypatch.setattr(call_encoder, "PICTURE_EVERY_S", 0.0)
    monkeypatch.setattr(call_encoder, "AT_ONCE", 10**9)
    client = VirtualClient(seed=5, size=size)
    for at in range(1, 20):
        say = partial(client.game.chat.say, "<Ann> hello", client.game.ticks + 40 * at)
        client.clock.call_at(client.clock.now() + 2 * at, say)
    record_play(tmp_path / "play", 4, client, seed=5)
    assert overview_of(tmp_path / "play").pictures > 20
    frames = list(frames_of(played_in(tmp_path / "play"), 20))
    said, *_ = chat_regions(size, largest_gui_scale(size))
    assert (client.display.grab()[said.slices] == 255).all(axis=2).any()
    for frame in frames:
        grey = (frame.picture == BLANK).all(axis=2)
        lines = (frame.picture == OUTSIDE).all(axis=2).any(axis=1)
        assert grey[said.slices][~lines[said.slices[0]]].all()
    shown = max((frame.picture != BLANK).any(axis=2).mean() for frame in frames)
    assert shown > (0.05 if size == (854, 480) else 0)  # the chat of the larger one may be anywhere


def test_an_episode_begins_without_the_picture_of_what_was_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a reset came by, menus too, is on no frame, though a picture of it was kept."""
    monkeypatch.setattr(call_encoder, "PICTURE_EVERY_S", 1e9)
    record_play(tmp_path / "play", 3, seed=5)
    assert overview_of(tmp_path / "play").pictures == 1
    assert all(
        (frame.picture == BLANK).all(axis=2).mean() > 0.9 for frame in frames_of(played_in(tmp_path / "play"), 20)
    )


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
    assert list(frames_of(played, 5))


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


def test_a_part_that_was_cut_out_shows_the_same_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(call_encoder, "PICTURE_EVERY_S", 0.0)
    monkeypatch.setattr(call_encoder, "AT_ONCE", 10**9)
    record_play(tmp_path / "play", 3, seed=5)
    cut(tmp_path / "play", tmp_path / "part.mcap", 0, 2**63 - 1)
    both = [list(frames_of(played_in(tmp_path / name), 20)) for name in ("play", "part.mcap")]
    assert [len(frames) for frames in both] == [len(both[0])] * 2
    assert all((one.picture == other.picture).all() for one, other in zip(*both, strict=True))
