"""The frames of what was played in a recording: the window, the pose, the keys and the action at each moment.

A frame shows what was recorded of the window: the last picture of its episode, and over it the lines that were read
last. All else is grey, as is the chat.
"""

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mc_nested.arena.demonstration import Demonstration, ShownStep
from mc_nested.live.devices import Frame
from mc_nested.live.recording.call_encoder import draw
from mc_nested.live.recording.demonstrations import RecordedPlay, timed
from mc_nested.live.recording.recording_file import Lost
from mc_nested.live.recording.text_pixels import TextPixels, paint
from mc_nested.live.vision.chat_region import BLANK


@dataclass(frozen=True)
class PlayedFrame:
    """A moment of an episode, and of its step that was under way, or came next.

    Attributes:
        picture: the window, (height, width, 3), red green blue.
        pose: x, y, z, yaw and pitch, as read last.
        held: the keys and buttons that were down until the next frame, as "w" and "mouse.left".
    """

    episode: int
    step: ShownStep
    picture: Frame
    pose: tuple[float, ...]
    held: set[str]


def frames_of(played: RecordedPlay, fps: int) -> Iterator[PlayedFrame]:
    """Return the frames of all episodes, so many a second, each from its beginning to the end of its last step."""
    due = deque(
        (at, index, step) for index, episode in enumerate(played.episodes) for at, step in _moments_of(episode, fps)
    )
    behind: Frame = np.full((*played.size[::-1], 3), BLANK, np.uint8)
    lines, pose = None, [0.0] * 5
    held: set[str] = set()
    frame: PlayedFrame | None = None
    for now, each in timed(played.path):
        while due and due[0][0] < now:
            if frame:
                yield frame
            _, index, step = due.popleft()
            frame = PlayedFrame(index, step, _picture(behind, lines), tuple(pose), set(held)) if step else None
        if isinstance(each, Lost):
            continue
        held = _down_after(each.call[each.call[0] == "elsewhere" :], held)
        if frame:
            frame.held.update(held)
        name, *said = each.call
        is_read = name == "screen" and said[0] in ("read", "read_position") and said[2] and "problem" not in said[2]
        if is_read:
            read = said[2] if said[0] == "read" else {"xyz": said[2]}
            pose = [*read.get("xyz", pose[:3]), read.get("yaw", pose[3]), read.get("pitch", pose[4])]
            lines = said[3] and said[3].get("text")
        if is_read or name == "grab":
            draw(each.pictures, behind)
        elif name == "note" and said[0] == "stands":
            behind[:] = BLANK  # a menu that the reset came by, which names worlds and servers
    if frame:
        yield frame


def _down_after(call: list[Any], held: set[str]) -> set[str]:
    """Return which keys and buttons are down after a call."""
    match call:
        case ["key" | "mouse" as device, "press" | "release" as done, which]:
            key = {which if device == "key" else f"mouse.{which}"}
            return held | key if done == "press" else held - key
    return held


def _moments_of(episode: Demonstration, fps: int) -> Iterator[tuple[float, ShownStep | None]]:
    """Return when each frame of an episode is, and its step; at last the episode's end, with None."""
    ends = [step.ended for step in episode.steps]
    count = math.ceil((ends[-1] - episode.began) * fps - 1e-9)
    for at in episode.began + np.arange(max(1, count)) / fps:
        yield at, episode.steps[np.searchsorted(ends[:-1], at, side="right")]
    yield ends[-1], None


def _picture(behind: Frame, lines: Any) -> Frame:
    picture = behind.copy()
    if lines:
        paint(picture, TextPixels.from_json(lines))
    return np.ascontiguousarray(picture[..., ::-1])
