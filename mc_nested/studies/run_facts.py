"""What a run's or a study's folder holds, in a few facts: for a list of runs."""

import datetime
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

from mc_nested.errors import McNestedError, RunError
from mc_nested.learn.runs.folder_kind import verb_in, verb_of_study
from mc_nested.learn.runs.folder_lock import holder_of
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.studies.folder import CONFIG, JOBS_FOLDER, StudyFolder
from mc_nested.toml_file import parse_document, read_toml_text

State = Literal["finished", "can be resumed", "in use", "damaged"]

OUR_OWN = (JOBS_FOLDER, "checkpoint", "episodes.csv")
"""Any of these tells a folder of this project's where its config.toml can't be read."""


@dataclass(frozen=True)
class RunFacts:
    """The facts of one folder, each with its meaning; what a damaged one doesn't say is empty or None."""

    folder: Annotated[Path, "the run's folder"]
    verb: Annotated[str | None, "the command that made it"]
    state: Annotated[State, "finished, can be resumed, in use or damaged"]
    why: Annotated[str | None, "what is damaged, or which process uses it"] = None
    designs: Annotated[Sequence[str], "names of what is built"] = ()
    agents: Annotated[Sequence[str], "names of who learns"] = ()
    presets: Annotated[Sequence[str], "names of the hyper-parameters"] = ()
    trials: Annotated[int | None, "trainings of each agent on each design"] = None
    episodes_done: Annotated[int | None, "of all trials; a study counts finished jobs"] = None
    episodes: Annotated[int | None, "how many there will be at most"] = None
    score: Annotated[float | None, "mean of the final scores"] = None
    optimum: Annotated[float | None, "the highest score possible"] = None
    size: Annotated[int, "bytes of all its files"] = 0
    begun: Annotated[datetime.datetime | None, "local time"] = None


def runs_in(folder: Path) -> list[RunFacts]:
    """Return the runs in a folder by name, or the folder itself if it is one; RunError if it can't be listed."""
    if own := facts_of(folder):
        return [own]
    try:
        inside = sorted(folder.iterdir()) if folder.exists() else []
    except OSError as error:
        raise RunError(f"{folder}: can't be listed, {error.strerror}: name a folder of runs") from error
    return [facts for facts in map(facts_of, inside) if facts]


def facts_of(folder: Path) -> RunFacts | None:
    """Return the facts of a run's folder, a damaged one's too; None if it is none."""
    file = folder / CONFIG
    if not file.is_file():
        return None
    verb = ""
    try:
        found = verb_in(parse_document(read_toml_text(file, RunError), str(file), RunError))
        if found is None:
            return None
        verb = found
        facts = _training(folder) if verb == "train" else _study(folder)
    except McNestedError as error:
        if not verb and not any((folder / name).exists() for name in OUR_OWN):
            return None
        facts = RunFacts(folder, verb or None, "damaged", str(error))
    facts = replace(facts, begun=datetime.datetime.fromtimestamp(file.stat().st_mtime), size=_size(folder))
    holder = holder_of(folder)
    return replace(facts, state="in use", why=holder) if holder and facts.state != "damaged" else facts


def _training(path: Path) -> RunFacts:
    folder = RunFolder.open(path)
    config = folder.config
    facts = RunFacts(
        path,
        "train",
        "can be resumed",
        designs=[config.scenario.name],
        agents=[f"{len(config.team.starts)} {config.team.networks}" if config.team else config.agent],
        presets=[Path(config.preset_name).stem],
        trials=config.trials,
        episodes_done=0,
        episodes=config.preset.episodes * config.trials,
        optimum=folder.scenario.optimum,
    )
    if folder.only_begun:
        return facts
    try:
        done, _, scores = folder.how_far()
    except RunError as error:
        return replace(facts, state="damaged", why=str(error), episodes_done=None)
    finals = [score for score in scores if score is not None]
    if len(finals) < config.trials:
        return replace(facts, episodes_done=done)
    return replace(facts, episodes_done=done, state="finished", score=sum(finals) / len(finals))


def _study(path: Path) -> RunFacts:
    folder = StudyFolder.open(path)
    config, outcomes = folder.config, folder.outcomes()
    return RunFacts(
        path,
        verb_of_study(config.study),
        "finished" if all(outcome for _, outcome in outcomes) else "can be resumed",
        designs=_each_once(scenario.name for job, _ in outcomes for scenario in job.scenarios),
        agents=_each_once(arm.labels.get("agent", arm.agent) for arm in config.arms),
        presets=_each_once(Path(arm.preset_name).stem for arm in config.arms),
        trials=config.trials,
        episodes_done=sum(job.episodes for job, outcome in outcomes if outcome),
        episodes=sum(job.episodes for job, _ in outcomes),
    )


def _each_once(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))


def _size(folder: Path) -> int:
    """Count the bytes of all files in a folder; links aren't followed."""
    return sum(Path(inside, name).lstat().st_size for inside, _, names in os.walk(folder) for name in names)
