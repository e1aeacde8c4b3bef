"""The files of a training's folder beside its checkpoint: config.toml, the tables of its episodes, and summary.json."""

import csv
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

import tomlkit
from pydantic import BaseModel

from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.runs.folder_kind import check_config
from mc_nested.toml_file import parse_toml, read_toml_text

CONFIG, SUMMARY = "config.toml", "summary.json"

Config = TypeVar("Config", bound=BaseModel)


def read_config(path: Path, model: type[Config], verb: str, what: str) -> Config:
    """The config.toml of an earlier training by that verb, of ``what`` kind; RunError if the folder isn't one's."""
    if not (path / CONFIG).is_file():
        raise RunError(f"{path}: no config.toml there: name the folder of a {what} (its --out)")
    text = read_toml_text(path / CONFIG, RunError)
    check_config(text, path, verb)
    return parse_toml(model, text, str(path / CONFIG), RunError)


def begin_folder(path: Path, config: BaseModel) -> None:
    """Make the folder and write config.toml; RunError if the disk refuses."""
    try:
        path.mkdir(parents=True, exist_ok=True)
        _write_text(path / CONFIG, tomlkit.dumps(config.model_dump(exclude_none=True)))
    except OSError as error:
        raise RunError(f"{path}: can't be written, {error.strerror}: name another folder") from error


@contextmanager
def writing_in(path: Path, verb: str) -> Iterator[None]:
    """Around writing there: RunError, one line that says how to resume, if the disk refuses."""
    try:
        yield
    except OSError as error:
        raise RunError(
            f"{path}: can't be written ({error}): make room, then mc-nested {verb} --resume {path} "
            f"goes on from the last checkpoint"
        ) from error


def write_results(
    path: Path, episodes: Sequence[EpisodeRow], evaluations: Sequence[EvaluationRow], summary: Mapping[str, Any]
) -> None:
    """Write the tables and the summary; OSError if the disk refuses, what was there is whole then."""
    _write_table(path / "episodes.csv", EpisodeRow._fields, episodes)
    _write_table(path / "evaluations.csv", EvaluationRow._fields, evaluations)
    _write_text(path / SUMMARY, json.dumps(summary, indent=2) + "\n")


def wall_s_so_far(path: Path) -> float:
    """Seconds that the training there took until its last save; 0 if the summary doesn't say."""
    try:
        return float(json.loads((path / SUMMARY).read_text("utf-8"))["wall_s"])
    except (OSError, ValueError, KeyError, TypeError):
        return 0.0


def _write_text(path: Path, text: str) -> None:
    with atomic_write(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8")


def _write_table(path: Path, header: Sequence[str], rows: Sequence[EpisodeRow | EvaluationRow]) -> None:
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
