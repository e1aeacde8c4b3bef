"""The episodes in a recording, as an agent can learn from them: whoever played them, a person or an agent."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.demonstration import Demonstration
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.rules import end_of_episode, is_inside
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import parse_scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.recording_file import PartEnd, TimedCall, facts_of, read_recording


def demonstrations_in(path: Path, scenario: Scenario) -> tuple[list[Demonstration], str]:
    """Return the whole episodes of a recording, and a line that says how many they are, and what is left out.

    Raise RecordingError if it is of another scenario, if nothing of it is whole, or an episode leaves the arena.
    """
    _check_scenario(path, scenario)
    damaged: list[str] = []
    try:
        found = list(_episodes(_notes(path, damaged), scenario, path))
    except (KeyError, ValueError, TypeError) as error:
        raise RecordingError(f"{path}: its notes are damaged ({error!r}): name another recording") from error
    whole = [episode for episode in found if episode is not None]
    cut_short = len(found) - len(whole)
    if not whole:
        what = "no whole episode: build until no block is left" if cut_short else "no action: build something"
        raise RecordingError("; ".join([f"{path}: holds {what}, or name another recording", *damaged]))
    said = [f"{path}: {len(whole)} whole episode{'s' if len(whole) > 1 else ''} to learn from"]
    said += [f"{cut_short} cut short, left out"] if cut_short else []
    return whole, "; ".join([*said, *damaged])


def _check_scenario(path: Path, scenario: Scenario) -> None:
    text = facts_of(path).get("scenario")
    if text is None:
        raise RecordingError(f"{path}: no scenario was played in it: name the recording of a build")
    theirs = parse_scenario(text, f"{path}: its scenario")
    if replace(theirs, name=scenario.name) != scenario:
        raise RecordingError(
            f"{path}: was recorded with {theirs.name}, whose size, design, start, steps or materials aren't those of "
            f"{scenario.name}: train in that scenario, or name another recording"
        )


def _notes(path: Path, damaged: list[str]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the kind and the facts of each note; "lost" where some may be missing: that is added to ``damaged``."""
    for each in read_recording(path):
        if isinstance(each, PartEnd) and each.problem:
            damaged.append(f"{each.path.name}: {each.problem}")
            yield "lost", {}
        elif isinstance(each, TimedCall) and each.call[0] == "note":
            yield each.call[1], each.call[2]


def _episodes(
    notes: Iterator[tuple[str, Mapping[str, Any]]], scenario: Scenario, path: Path
) -> Iterator[Demonstration | None]:
    """Yield each episode that has an action; None for one that didn't come to its end."""
    material: int | None = None
    steps: list[tuple[Following, Outcome]] = []
    placed, asked = set[Cell](), None
    for kind, facts in notes:
        if kind in ("resets", "lost"):
            if steps:
                yield None
            material, steps, placed, asked = facts.get("material"), [], set(), None
        elif kind == "acts":
            asked = facts
        elif kind == "done" and material is not None and asked is not None:
            done = Action(facts.get("instead", asked["action"]))
            outcome = Outcome(_cell(facts["cell"]), facts["placed"] and _cell(facts["placed"]), done)
            for cell in filter(None, (outcome.cell, outcome.placed)):
                if not is_inside(cell, scenario.size):
                    raise RecordingError(f"{path}: an episode leaves the arena at {cell}: name another recording")
            steps.append(((done, asked.get("material")), outcome))
            placed |= {outcome.placed} if outcome.placed else set()
            if any(end_of_episode(scenario.blocks - len(placed), len(steps), scenario.step_limit)):
                yield Demonstration(material, tuple(steps))
                material, steps = None, []
    if steps:
        yield None


def _cell(value: Any) -> Cell:
    x, y = value
    return int(x), int(y)
