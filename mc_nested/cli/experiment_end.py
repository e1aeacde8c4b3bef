"""What an experiment says at its end: what was found, its files, and which to open."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.console import RenderableType

from mc_nested.cli.output import Output


def say_end(
    output: Output, folder: Path, files: Mapping[str, str], found: Mapping[str, Any], *shown: RenderableType
) -> None:
    """Print what was found and where the files are, each by what it is; the first of them says most."""
    paths = {what: folder / name for what, name in files.items()}
    lines = [f"{what + ':':8}{path}" for what, path in paths.items()]
    output.result({"folder": folder, "files": paths, **found}, *shown, *lines)
    output.hint(f"next:   open {next(iter(paths.values()))}")
