"""The episodes in a recording, for others to learn from: whoever played them, a person or an agent."""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.demonstration import Demonstration, ShownStep
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import end_of_episode, is_inside
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import parse_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.recording_file import Lost, TimedCall, facts_of, read_recording


@dataclass
class RecordedPlay:
    """The episodes of a recording that have an action, its window's width and height, and what is damaged.

    ``left_out`` counts actions that failed, that an unknown one came before, or that came behind an episode's end.
    """

    path: Path
    scenario: Scenario
    size: tuple[int, int]
    episodes: list[Demonstration] = field(default_factory=list)
    left_out: int = 0
    damage: list[str] = field(default_factory=list)


def played_in(path: Path) -> RecordedPlay:
    """Return what was played in a recording.

    Raise RecordingError if no action of a design's was confirmed in it, or an episode leaves the arena.
    """
    facts = facts_of(path)
    if "scenario" not in facts:
        raise RecordingError(f"{path}: names no design: name the recording of a training, a play or a build")
    scenario = parse_scenario(facts["scenario"], f"{path}: its scenario")
    try:
        width, height = map(int, facts["size"].split("x"))
        played = RecordedPlay(path, scenario, (width, height))
        _follow(played)
    except (KeyError, ValueError, TypeError) as error:
        raise RecordingError(f"{path}: its notes are damaged ({error!r}): name another recording") from error
    played.episodes = [each for each in played.episodes if each.steps]
    if not played.episodes:
        what = f"{path}: no action was confirmed in it: build something, or name another recording"
        raise RecordingError("; ".join([what, *played.damage]))
    return played


def demonstrations_in(path: Path, scenario: Scenario) -> tuple[list[Demonstration], str]:
    """Return the whole episodes of a recording, and a line that says how many they are, and what is left out.

    Raise RecordingError as ``played_in``, and if it is of another scenario, or nothing of it is whole.
    """
    played = played_in(path)
    theirs = played.scenario
    if replace(theirs, name=scenario.name) != scenario:
        raise RecordingError(
            f"{path}: was recorded with {theirs.name}, whose size, design, start, steps or materials aren't those of "
            f"{scenario.name}: train in that scenario, or name another recording"
        )
    whole = [each for each in played.episodes if each.is_whole]
    if not whole:
        what = f"{path}: holds no whole episode: build until no block is left, or name another recording"
        raise RecordingError("; ".join([what, *played.damage]))
    cut_short = len(played.episodes) - len(whole)
    said = [f"{path}: {len(whole)} whole episode{'s' if len(whole) > 1 else ''} to learn from"]
    said += [f"{cut_short} cut short, left out"] if cut_short else []
    return whole, "; ".join([*said, *played.damage])


def timed(path: Path) -> Iterator[tuple[float, TimedCall | Lost]]:
    """Return everything in a recording, each with its time by the run's own clock, in seconds."""
    now = 0.0
    for each in read_recording(path):
        if isinstance(each, TimedCall) and each.call[0] in ("now", "sleep"):
            now = max(now, float(each.call[1]))
        yield now, each


def _follow(played: RecordedPlay) -> None:
    """Fill in what the recording's notes say."""
    scenario = played.scenario
    episode: Demonstration | None = None
    material: int | None = None
    asked: dict[str, Any] = {}
    for now, each in timed(played.path):
        kind, told = each.call[1:3] if isinstance(each, TimedCall) and each.call[0] == "note" else ("", {})
        if isinstance(each, Lost):
            played.damage.append(each.what)
            episode = material = None
        elif kind == "resets":
            episode, material = None, told["material"]
        elif kind == "stands" and material is not None:
            episode = Demonstration(material, [], now)
            played.episodes.append(episode)
        elif kind == "acts":
            asked = told
            played.left_out += 1
        elif kind == "done" and episode is not None and material is not None:
            action, material = Action(told.get("instead", asked["action"])), asked.get("material", material)
            outcome = Outcome(_cell(told["cell"], played), told["placed"] and _cell(told["placed"], played), action)
            episode.steps.append(ShownStep(action, material, outcome, now))
            played.left_out -= 1
            placed = {step.outcome.placed for step in episode.steps} - {None}
            if any(end_of_episode(scenario.blocks - len(placed), len(episode.steps), scenario.step_limit)):
                episode.is_whole, episode = True, None


def _cell(value: Any, played: RecordedPlay) -> Cell:
    x, y = value
    cell = int(x), int(y)
    if not is_inside(cell, played.scenario.size):
        raise RecordingError(f"{played.path}: an episode leaves the arena at {cell}: name another recording")
    return cell
