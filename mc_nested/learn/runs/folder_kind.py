"""Which command a folder belongs to, if any; a key of its config.toml that only that command writes says which."""

from pathlib import Path

from mc_nested.atomic_file import is_leftover
from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.toml_file import parse_document

VERB_OF_KEY = {
    "agent": "train",
    "agents": "reproduce",
    "choices": "reproduce",
    "variants": "sweep",
    "parts": "sweep",
    "contestants": "benchmark",
    "arms": "reproduce",
    "builders": "cooperate",
}


VIEW = "view"
VIEW_FILES = frozenset({"now.json", "history.jsonl", "pause.request", "stop.request", "answer.request", LOCK})
"""A run's folder of what ``mc-nested view`` shows, and its files; a run that never began leaves nothing else."""

FORMAT = 2
"""What the files of a run or an experiment are like: it goes up by one when they change."""


def check_config(text: str, folder: Path, verb: str) -> None:
    """RunError if the text of config.toml is of another format, or that of another command's folder."""
    document = parse_document(text, str(folder / "config.toml"), RunError)
    if document.get("format") != FORMAT:
        raise RunError(f"{folder}: written by another version of mc-nested: open it with that one, or train it again")
    found = [other for key, other in VERB_OF_KEY.items() if key in document]
    if found and verb not in found:
        raise RunError(
            f"{folder}: the folder of mc-nested {found[0]}, not of {verb}: name another, or go on with it by "
            f"mc-nested {found[0]} --resume {folder}"
        )


def check_free(path: Path) -> None:
    """RunError if the path can't become a new folder: it holds something already, or the system refuses.

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
    """Whether it is a run's view folder, with nothing else in it."""
    return (
        entry.name == VIEW
        and entry.is_dir()
        and all(is_leftover(each) or each.name in VIEW_FILES for each in entry.iterdir())
    )
