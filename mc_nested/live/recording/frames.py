"""What was played in a recording, for others to learn from: its episodes, as the Env counts them, and their frames.

Times are the run's own clock, in seconds. A frame shows what was recorded of the window: the last picture in its
episode, and the lines that were read last. The rest is grey, as is the chat.
"""

from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import ArenaEnv, Observation, step_in
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import parse_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.recording_file import PartEnd, facts_of, read_recording
from mc_nested.live.recording.text_pixels import TextPixels, paint
from mc_nested.live.vision.chat_region import BLANK


@dataclass(frozen=True)
class Step:
    """An action that was confirmed at the time ``ended``, and what ``ArenaEnv.step`` returns for it.

    ``action`` is the one that was done: where a person had taken over, theirs.
    """

    action: Action
    material: int
    outcome: Outcome
    observation: Observation
    reward: float
    terminated: bool
    truncated: bool
    info: dict[str, Any]
    ended: float


@dataclass(frozen=True)
class Episode:
    """One episode from its reset's end on, at the time ``began``; ``observation`` and ``info`` are the reset's."""

    scenario: Scenario
    began: float
    observation: Observation
    info: dict[str, Any]
    steps: list[Step] = field(default_factory=list)


@dataclass(frozen=True)
class Played:
    """The episodes of a recording, in which at least one action each was confirmed, and what of it is missing there.

    ``left_out`` counts the actions that failed, or before which something is lost, or that came after an episode's end.
    """

    path: Path
    size: tuple[int, int]
    episodes: list[Episode]
    left_out: int
    damage: list[str]


def played_in(path: Path) -> Played:
    """Return what was played in a recording; RecordingError if nothing of it can be used."""
    facts = facts_of(path)
    if "scenario" not in facts:
        raise RecordingError(f"{path}: says of no design that it was built: name a recording of train, play or build")
    scenario = parse_scenario(facts["scenario"], f"{path}: its scenario")
    game = _Told()
    env, now, acts = ArenaEnv(game, scenario), 0.0, 0
    asked: dict[str, Any] | None = None
    episode: Episode | None = None
    episodes: list[Episode] = []
    damage = []
    with _undamaged(path):
        width, height = map(int, facts["size"].split("x"))
        for each in read_recording(path):
            if isinstance(each, PartEnd) and each.problem:
                damage.append(f"{each.path.name}: {each.problem}")
                episode = None
            if isinstance(each, PartEnd | KeptPicture):
                continue
            now = _time_after(each.call, now)
            kind, said = each.call[1:3] if each.call[0] == "note" else ("", {})
            acts += kind == "acts"
            if kind == "resets":
                episode, material = None, said["material"]
            elif kind == "stands":
                game.outcome = Outcome(_cell(said["cell"]), None)
                observation, info = env.reset(options={"material": scenario.materials[material].name})
                episode = Episode(scenario, now, observation, info)
                episodes.append(episode)
            elif kind == "acts":
                asked = said
            elif kind == "done" and episode and asked and _cell(asked["cell"]) == env.cell:
                instead = said.get("instead")
                action = Action(asked["action"] if instead is None else instead)
                material = asked.get("material", material)
                placed = None if said["placed"] is None else _cell(said["placed"])
                game.outcome = Outcome(_cell(said["cell"]), placed)
                seen = env.step(step_in(scenario, action, material))
                episode.steps.append(Step(action, material, game.outcome, *seen, now))
                if seen[2] or seen[3]:
                    episode = None
    episodes = [each for each in episodes if each.steps]
    if not episodes:
        raise RecordingError(f"{path}: holds no action that was confirmed: name another recording")
    return Played(path, (width, height), episodes, acts - sum(len(each.steps) for each in episodes), damage)


class _Told:
    """A game whose outcomes are told it beforehand."""

    resumable = log = None

    def __init__(self) -> None:
        self.outcome = Outcome((0, 0), None)

    def reset(self, _material: int) -> Cell:
        return self.outcome.cell

    def act(self, *_asked: object) -> Outcome:
        return self.outcome


@dataclass(frozen=True)
class PlayedFrame:
    """A moment of an episode.

    Attributes:
        episode: its number.
        step: the number of the step that was under way, or came next.
        picture: the window, (height, width, 3), red green blue.
        held: the keys and buttons that were down at some time until the next frame, as "w" and "mouse.left".
        pose: x, y, z, yaw and pitch, as read last.
    """

    episode: int
    step: int
    picture: Frame
    held: frozenset[str]
    pose: tuple[float, ...]


def frames_of(played: Played, fps: int) -> Iterator[PlayedFrame]:
    """Return the frames of its episodes, so many a second, each from its beginning to its last step's end."""
    due = deque(moment for index, episode in enumerate(played.episodes) for moment in _moments_of(index, episode, fps))
    shown, now, pictures = _Shown(played.size), 0.0, deque[KeptPicture]()
    held: set[str] = set()
    down: set[str] = set()
    pose = [0.0] * 5
    frame: PlayedFrame | None = None
    with _undamaged(played.path):
        for each in read_recording(played.path):
            if isinstance(each, KeptPicture):
                pictures.append(each)
            if isinstance(each, PartEnd | KeptPicture):
                continue
            now = _time_after(each.call, now)
            while due and due[0][0] < now:
                if frame:
                    yield replace(frame, held=frozenset(down))
                _, episode, step = due.popleft()
                frame = None if step is None else PlayedFrame(episode, step, shown.picture(), frozenset(), tuple(pose))
                down = set(held)
            name, *said = each.call[each.call[0] == "elsewhere" :]
            is_read = name == "screen" and said[0] in ("read", "read_position") and bool(said[2])
            while pictures and pictures[0].at <= each.at:
                picture = pictures.popleft()
                if name == "grab" or (is_read and "problem" not in said[2]):
                    shown.take(picture)
            if name in ("key", "mouse") and said[0] in ("press", "release"):
                key = said[1] if name == "key" else f"mouse.{said[1]}"
                if said[0] == "press":
                    held.add(key)
                    down.add(key)
                else:
                    held.discard(key)
            elif is_read:
                read = said[2] if said[0] == "read" else {"xyz": said[2]}
                pose = [*(read.get("xyz") or pose[:3]), read.get("yaw", pose[3]), read.get("pitch", pose[4])]
                shown.lines = said[3] and said[3].get("text")
            elif name == "note" and said[0] == "stands":
                shown.forget()
        if frame:
            yield replace(frame, held=frozenset(down))


def _moments_of(index: int, episode: Episode, fps: int) -> Iterator[tuple[float, int, int | None]]:
    """Return the time of each frame of an episode, the episode's number and its step's, at last its end and None."""
    number = 0
    for step, done in enumerate(episode.steps):
        while number == 0 or episode.began + number / fps < done.ended:
            yield episode.began + number / fps, index, step
            number += 1
    yield done.ended, index, None


class _Shown:
    """What is known of the window's picture.

    Args:
        size: the window's width and height when the recording began; what lies outside is cut off.
    """

    def __init__(self, size: tuple[int, int]) -> None:
        self._behind: Frame = np.full((size[1], size[0], 3), BLANK, np.uint8)
        self.lines: Any = None

    def forget(self) -> None:
        """Forget the picture: a menu that a reset came by may be on it, which names worlds and servers."""
        self._behind[:] = BLANK

    def take(self, picture: KeptPicture) -> None:
        frame = cv2.imdecode(np.frombuffer(picture.png, np.uint8), cv2.IMREAD_COLOR)
        if frame is None:
            raise ValueError("a picture that is none")
        part = self._behind[Region(*picture.region).slices if picture.region else slice(None)]
        height, width = (min(both) for both in zip(part.shape[:2], frame.shape[:2], strict=True))
        part[:height, :width] = frame[:height, :width]

    def picture(self) -> Frame:
        picture = self._behind.copy()
        if self.lines:
            paint(picture, TextPixels.from_json(self.lines))
        return np.ascontiguousarray(picture[..., ::-1])


def _time_after(call: Sequence[Any], now: float) -> float:
    return max(now, float(call[1])) if call[0] in ("now", "sleep") else now


def _cell(value: Sequence[int]) -> Cell:
    x, y = value
    return int(x), int(y)


@contextmanager
def _undamaged(path: Path) -> Iterator[None]:
    try:
        yield
    except (KeyError, IndexError, TypeError, ValueError) as error:
        raise RecordingError(f"{path}: what it says is damaged ({error!r}): cut that part away") from error
