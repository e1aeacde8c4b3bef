"""Which verb a folder belongs to, told by its config.toml: each has a key that the others' haven't."""

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
