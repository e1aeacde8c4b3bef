"""A recording's frames are what its calls say, each taken from them here in the plainest way."""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mc_nested.arena.demonstration import Demonstration
from mc_nested.live.recording import call_encoder
from mc_nested.live.recording.cut import cut
from mc_nested.live.recording.demonstrations import played_in
from mc_nested.live.recording.frames import PlayedFrame, frames_of
from mc_nested.live.recording.recording_file import overview_of
from mc_nested.live.recording.text_pixels import OUTSIDE
from mc_nested.live.vision.chat_region import BLANK, chat_regions
from mc_nested.live.vision.layout import largest_gui_scale
from sim.client.client import VirtualClient
from tests.live.recording.recorded_play import record_play, timed
from tests.recordings.test_recordings import VIRTUAL

LINE = VIRTUAL / "rehearsal-window.mcap"


def test_every_call_is_in_the_frame_of_its_time(fresh: Path) -> None:
    played, fps = played_in(fresh), 20
    frames = list(frames_of(played, fps))
    for number, episode in enumerate(played.episodes):
        own = [frame for frame in frames if frame.episode == number]
        ends = [episode.began + (at + 1) / fps for at in range(len(own) - 1)] + [episode.steps[-1].ended]
        assert len(own) == np.ceil((episode.steps[-1].ended - episode.began) * fps - 1e-9)
        check_frames(own, episode, [episode.began + at / fps for at in range(len(own))], ends, fresh)


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


def check_frames(
    frames: list[PlayedFrame], episode: Demonstration, begins: list[float], ends: list[float], path: Path
) -> None:
    """Check keys, poses and steps by all that is recorded, from the beginning, for each frame."""
    calls, holds = list(timed(path)), holds_in(path)
    for frame, begin, end in zip(frames, begins, ends, strict=True):
        pose: dict[str, Any] = {}
        for now, (name, *said) in calls:
            if name == "screen" and said[0] in ("read", "read_position") and said[2] and now <= begin:
                pose |= said[2] if said[0] == "read" else {"xyz": said[2]}
        assert frame.held == {key for key, press, release in holds if press <= end and release > begin}
        assert frame.pose == (*pose["xyz"], pose["yaw"], pose["pitch"])
        assert frame.step is next(step for step in episode.steps if step.ended > begin)


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
    assert (overview_of(tmp_path / "play").pictures or 0) > 20
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


def test_a_part_that_was_cut_out_shows_the_same_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(call_encoder, "PICTURE_EVERY_S", 0.0)
    monkeypatch.setattr(call_encoder, "AT_ONCE", 10**9)
    record_play(tmp_path / "play", 3, seed=5)
    cut(tmp_path / "play", tmp_path / "part.mcap")
    both = [list(frames_of(played_in(tmp_path / name), 20)) for name in ("play", "part.mcap")]
    assert [len(frames) for frames in both] == [len(both[0])] * 2
    assert all((one.picture == other.picture).all() for one, other in zip(*both, strict=True))
