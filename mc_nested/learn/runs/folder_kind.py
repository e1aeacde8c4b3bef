"""Which command a folder belongs to, if any; a key of its config.toml that only that command writes says which."""

from collections.abc import Mapping
from pathlib import Path

from mc_nested.atomic_file import is_leftover
from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.toml_file import parse_document

STUDY = "study"
"""The key of a study's config.toml that names it."""

VIEW = "view"
VIEW_FILES = frozenset(
    {"now.json", "history.jsonl", *(f"{what}.request" for what in ("pause", "stop", "answer", "takeover")), LOCK}
)
"""A run's folder of what ``mc-nested view`` shows, and its files; a run that never began leaves nothing else."""

FORMAT = 3
"""What the files of a run or an experiment are like: it goes up by one when they change."""


def verb_of_study(name: str) -> str:
    """Return the verb that runs a study: the paper's own experiment has one to itself."""
    return name if name == "reproduce" else f"study {name}"


def verb_in(document: Mapping[str, object]) -> str | None:
    """Return the verb that wrote this config.toml; None if it is no run's."""
    if "agent" in document:
        return "train"
    return verb_of_study(str(document[STUDY])) if STUDY in document else None


def check_config(text: str, folder: Path, *verbs: str) -> None:
    """Raise RunError if config.toml's text is of another format, or of another verb's folder than those named."""
    document = parse_document(text, str(folder / "config.toml"), RunError)
    if document.get("format") != FORMAT:
        raise RunError(f"{folder}: written by another version of mc-nested: open it with that one, or train it again")
    found = verb_in(document)
    if found and verbs and found not in verbs:
        raise RunError(
            f"{folder}: the folder of mc-nested {found}, not of {verbs[0]}: name another, or go on with it by "
            f"mc-nested {found} --resume {folder}"
        )


def check_free(path: Path) -> None:
    """Raise RunError if the path can't become a new folder: it holds something already, or the system refuses.

    What a killed process left half-written or for its view doesn't count, nor the lock of whoever asks.
    """
    try:
        if path.exists() and not path.is_dir():
            raise RunError(f"{path}: is a file: name a new folder, nothing was overwritten")
        entries = path.iterdir() if path.exists() else iter(())
        taken = not all(is_leftover(entry) or entry.name == LOCK or _is_view(entry) for entry in entries)
    except OSError as error:
        raise RunError(f"{path}: can't be used, {error.strerror}: name another folder") from error
    if taken:
        raise RunError(f"{path}: exists and is not empty: name a new folder, nothing was overwritten")


def _is_view(entry: Path) -> bool:
    """Return whether it is a run's view folder, with nothing else in it."""
    return (
        entry.name == VIEW
        and entry.is_dir()
        and all(is_leftover(each) or each.name in VIEW_FILES for each in entry.iterdir())
    )
