"""What a shell completes beside verbs and options: names of one's own runs and profiles, and those that are shipped.

A verb's module takes longer to load than a person waits at a Tab. So where a run, a profile or a verb is asked for,
none is loaded.
"""

import contextlib
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.live.profile.folder import profile_folder

RUNS = Path("runs")
"""Where runs are written, and looked for, unless another folder is named."""

CONFIG = "config.toml"

COMPLETES = "_MC_NESTED_COMPLETE"
"""The environment variable by which a shell asks for completions, as Typer names it."""

Complete = Callable[[str], list[str]]
"""The values that begin with what is typed so far."""


def complete_runs(incomplete: str) -> list[str]:
    """List folders of runs: those in runs/, and those where the typed path leads."""
    path = Path(incomplete)
    there = RUNS if incomplete in ("", ".", "./") else path if incomplete.endswith("/") else path.parent
    found = (str(entry) for place in dict.fromkeys((RUNS, there)) for entry in _inside(place))
    return [name for name in found if name.startswith(incomplete) and Path(name, CONFIG).is_file()]


def complete_profiles(incomplete: str) -> list[str]:
    """List names of one's profiles."""
    names = [file.stem for file in _inside(profile_folder()) if file.suffix == ".toml"]
    return [name for name in names if name.startswith(incomplete)]


def complete_of(names: Callable[[], Iterable[str]]) -> Complete:
    """Complete some of these; after a comma, the same with what stands before it."""

    def complete(incomplete: str) -> list[str]:
        before, comma, last = incomplete.rpartition(",")
        return [before + comma + name for name in names() if name.startswith(last)]

    return complete


QUICK: dict[str, Complete] = {
    "--profile": complete_profiles,
    "--resume": complete_runs,
    "--from": complete_runs,
    "play": complete_runs,
    "view": complete_runs,
    **{f"runs {verb}": complete_runs for verb in ("show", "evaluate", "rename", "export", "delete")},
    **{f"profiles {verb}": complete_profiles for verb in ("show", "rename", "delete")},
}
"""What completes the word behind an option, or behind a verb: one's own names."""


def quick_app(verbs: Iterable[str]) -> typer.Typer | None:
    """Make what answers the shell at once; None where a verb's module is needed to know what can stand there."""
    *before, incomplete = typed_words()
    complete = None
    if not incomplete.startswith("-"):
        names = complete_of(lambda: verbs)
        complete = (QUICK.get(before[-1]) or QUICK.get(" ".join(before[:2]))) if before else names
    if complete is None:
        return None
    app = typer.Typer()

    @app.command(context_settings={"ignore_unknown_options": True})
    def typed(words: Annotated[list[str], typer.Argument(autocompletion=complete)]) -> None:
        """Take any words: they are only completed."""

    return app


def typed_words() -> list[str]:
    """List the words typed behind mc-nested; the last one is what the shell asks to complete, or empty."""
    text = os.environ.get("_TYPER_COMPLETE_ARGS") or os.environ.get("COMP_WORDS", "")
    words = [*text.split(), *([""] if text.endswith((" ", "\n")) else [])]
    index = os.environ.get("COMP_CWORD")
    typed = words[1:] if index is None else [*words, ""][1 : int(index) + 1]
    return typed or [""]


def _inside(folder: Path) -> list[Path]:
    with contextlib.suppress(OSError):
        return sorted(folder.iterdir())
    return []
