"""What was played in a recording, for others to learn from: its episodes, as the Env counts them, and their frames.

Times are the run's own clock, in seconds. A frame shows what was recorded of the window: the last picture of its
episode, and over it the lines that were read last. All else is grey, as is the chat.
"""

from collections import deque
from collections.abc import Iterator
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
    """An action, confirmed at ``ended``, a player's where they had taken over, and what ``ArenaEnv.step`` returned."""

    action: Action
    material: int
    outcome: Outcome
    ended: float
    observation: Observation
    reward: float
    terminated: bool
    truncated: bool
    info: dict[str, Any]


@dataclass(frozen=True)
class Episode:
    """The steps behind a reset that ended at ``began``; ``observation`` and ``info`` are what it returned."""

    began: float
    observation: Observation
    info: dict[str, Any]
    steps: list[Step] = field(default_factory=list)


@dataclass(frozen=True)
class Played:
    """The episodes of a recording that have a step, the window's width and height, and what is damaged.

    ``left_out`` counts actions that failed, that an unknown one came before, or that came behind an episode's end.
    """

    path: Path
    scenario: Scenario
    size: tuple[int, int]
    episodes: list[Episode]
    left_out: int
    damage: list[str]


class _Told:
    """A game whose outcomes are told it beforehand."""

    resumable = log = None
    outcome = Outcome((0, 0), None)

    def reset(self, _material: int) -> Cell:
        return self.outcome.cell

    def act(self, *_asked: object) -> Outcome:
        return self.outcome


def played_in(path: Path) -> Played:
    """Return what was played in a recording; RecordingError if no action of a design's was confirmed in it."""
    facts = facts_of(path)
    if "scenario" not in facts:
        raise RecordingError(f"{path}: names no design: name the recording of a training, a play or a build")
    scenario = parse_scenario(facts["scenario"], f"{path}: its scenario")
    game = _Told()
    env = ArenaEnv(game, scenario)
    episodes: list[Episode] = []
    damage: list[str] = []
    material, acts, is_known = 0, 0, False
    asked: dict[str, Any] = {}
    for now, (name, *said), _ in _calls_in(path):
        if name == "lost":
            damage.append(said[0])
        kind, facts_now = (name, {}) if name != "note" else said
        if kind in ("lost", "resets"):
            material, is_known = facts_now.get("material", 0), False
        elif kind == "stands":
            game.outcome, is_known = Outcome(_cell(facts_now["cell"]), None), True
            episodes.append(Episode(now, *env.reset(options={"material": scenario.materials[material].name})))
        elif kind == "acts":
            asked, acts = facts_now, acts + 1
        elif kind == "done" and is_known and _cell(asked["cell"]) == env.cell:
            instead, placed = facts_now.get("instead"), facts_now["placed"]
            action = Action(asked["action"] if instead is None else instead)
            material = asked.get("material", material)
            game.outcome = Outcome(_cell(facts_now["cell"]), placed and _cell(placed))
            step = Step(action, material, game.outcome, now, *env.step(step_in(scenario, action, material)))
            episodes[-1].steps.append(step)
            is_known = not (step.terminated or step.truncated)
    episodes = [each for each in episodes if each.steps]
    if not episodes:
        raise RecordingError(f"{path}: no action was confirmed in it: name another recording")
    width, height = map(int, facts["size"].split("x"))
    return Played(path, scenario, (width, height), episodes, acts - sum(len(each.steps) for each in episodes), damage)


@dataclass(frozen=True)
class PlayedFrame:
    """A moment of an episode, and of its step that was under way, or came next.

    Attributes:
        picture: the window, (height, width, 3), red green blue.
        pose: x, y, z, yaw and pitch, as read last.
        held: the keys and buttons that were down until the next frame, as "w" and "mouse.left".
    """

    episode: int
    step: Step
    picture: Frame
    pose: tuple[float, ...]
    held: frozenset[str] = frozenset()


def frames_of(played: Played, fps: int) -> Iterator[PlayedFrame]:
    """Return the frames of all episodes, so many a second, each from its beginning to the end of its last step."""
    due = deque(moment for index in range(len(played.episodes)) for moment in _moments_of(played, index, fps))
    behind: Frame = np.full((*played.size[::-1], 3), BLANK, np.uint8)
    lines, pose = None, [0.0] * 5
    held: set[str] = set()
    down: set[str] = set()
    frame: PlayedFrame | None = None
    for now, (name, *said), pictures in _calls_in(played.path):
        while due and due[0][0] < now:
            if frame:
                yield replace(frame, held=frozenset(down))
            _, index, step = due.popleft()
            frame = PlayedFrame(index, step, _picture(behind, lines), tuple(pose)) if step else None
            down = set(held)
        if name in ("key", "mouse") and said[0] in ("press", "release"):
            key = said[1] if name == "key" else f"mouse.{said[1]}"
            held = held | {key} if said[0] == "press" else held - {key}
            down |= held
        elif name == "screen" and said[0] in ("read", "read_position") and said[2] and "problem" not in said[2]:
            read = said[2] if said[0] == "read" else {"xyz": said[2]}
            pose = [*read.get("xyz", pose[:3]), read.get("yaw", pose[3]), read.get("pitch", pose[4])]
            lines = said[3] and said[3].get("text")
            _paste(behind, pictures)
        elif name == "grab":
            _paste(behind, pictures)
        elif name == "note" and said[0] == "stands":
            behind[:] = BLANK  # a menu that the reset came by, which names worlds and servers
    if frame:
        yield replace(frame, held=frozenset(down))


def _moments_of(played: Played, index: int, fps: int) -> Iterator[tuple[float, int, Step | None]]:
    """Return when each frame of an episode is, the episode's number, and its step; at last the end, with None."""
    episode, number = played.episodes[index], 0
    for step in episode.steps:
        while number == 0 or episode.began + number / fps < step.ended:
            yield episode.began + number / fps, index, step
            number += 1
    yield episode.steps[-1].ended, index, None


def _calls_in(path: Path) -> Iterator[tuple[float, list[Any], list[KeptPicture]]]:
    """Return each call with its time and the pictures taken in it; ["lost", why] behind a file that ends early."""
    now, pictures = 0.0, deque[KeptPicture]()
    for each in read_recording(path):
        if isinstance(each, KeptPicture):
            pictures.append(each)
        elif isinstance(each, PartEnd):
            if each.problem:
                yield now, ["lost", f"{each.path.name}: {each.problem}"], []
        else:
            call = each.call[each.call[0] == "elsewhere" :]
            now = max(now, float(call[1])) if call[0] in ("now", "sleep") else now
            count = sum(picture.at <= each.at for picture in pictures)
            yield now, call, [pictures.popleft() for _ in range(count)]


def _paste(behind: Frame, pictures: list[KeptPicture]) -> None:
    """Draw pictures of the window, or of regions of it; what lies outside, since it was larger once, is cut off."""
    for each in pictures:
        frame = cv2.imdecode(np.frombuffer(each.png, np.uint8), cv2.IMREAD_COLOR)
        part = behind[Region(*each.region).slices] if each.region else behind
        if frame is not None:
            height, width = np.minimum(part.shape[:2], frame.shape[:2])
            part[:height, :width] = frame[:height, :width]


def _picture(behind: Frame, lines: Any) -> Frame:
    picture = behind.copy()
    if lines:
        paint(picture, TextPixels.from_json(lines))
    return np.ascontiguousarray(picture[..., ::-1])


def _cell(value: Any) -> Cell:
    return int(value[0]), int(value[1])
