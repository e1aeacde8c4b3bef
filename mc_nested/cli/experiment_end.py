"""What an experiment says at its end: what was found, its files, and which to open."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from rich.console import RenderableType

from mc_nested.cli.output import Output


@dataclass(frozen=True)
class Experiment:
    """What an experiment prints."""

    folder: Annotated[Path, "its folder"]
    files: Annotated[Mapping[str, Path], "what was written, by what it is"]


@dataclass(frozen=True)
class Reproduced(Experiment):
    """What ``reproduce`` prints."""

    claims: Annotated[
        Sequence[object],
        "letter, claim and verdict of each; of --robustness also choices, each with its verdict; of --beyond also "
        "trials, that would decide it, null of more than 1,000 or of what is counted",
    ]


@dataclass(frozen=True)
class Benchmarked(Experiment):
    """What ``benchmark`` prints."""

    measures: Annotated[Sequence[object], "of each contestant: trials, solved, and its episodes to the optimum"]


def say_end(
    output: Output,
    kind: type[Experiment],
    folder: Path,
    files: Mapping[str, str],
    found: Mapping[str, Any],
    *shown: RenderableType,
) -> None:
    """Print what was found and where the files are, each by what it is; the first of them says most."""
    paths = {what: folder / name for what, name in files.items()}
    lines = [f"{what + ':':8}{path}" for what, path in paths.items()]
    output.result(kind(folder, paths, **found), *shown, *lines)
    output.hint(f"next:   open {next(iter(paths.values()))}")
