"""Whose a folder is: nobody's yet, or a verb's, told by a key of its config.toml that the others' haven't."""

from pathlib import Path

from mc_nested.errors import RunError
from mc_nested.toml_file import parse_document

TOLD_BY = {"agent": "train", "agents": "reproduce", "variants": "sweep"}


def refuse_others(text: str, folder: Path, verb: str) -> None:
    """RunError where the config.toml's text is that of another verb's folder."""
    document = parse_document(text, str(folder / "config.toml"), RunError)
    found = [other for key, other in TOLD_BY.items() if key in document]
    if found and verb not in found:
        raise RunError(
            f"{folder}: the folder of mc-nested {found[0]}, not of {verb}: name another, or go on with it by "
            f"mc-nested {found[0]} --resume {folder}"
        )


def refuse_taken(path: Path) -> None:
    """RunError where the path can't be a new folder, because it holds anything or the system refuses."""
    try:
        taken = path.exists() and (not path.is_dir() or any(path.iterdir()))
    except OSError as error:
        raise RunError(f"{path}: can't be used, {error.strerror}: name another folder") from error
    if taken:
        raise RunError(f"{path}: exists and is not empty: name a new folder, nothing was overwritten")
