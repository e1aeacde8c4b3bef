"""Reading the project's TOML files: scenarios, presets and profiles. Each is a pydantic model; errors are one line."""

import difflib
import json
from collections.abc import Collection, Sequence
from importlib import resources
from pathlib import Path
from typing import TypeVar, get_args

import tomlkit
from pydantic import AfterValidator, BaseModel, ConfigDict, ValidationError
from pydantic_core import ErrorDetails
from tomlkit.exceptions import TOMLKitError

from mc_nested.errors import UserError

Model = TypeVar("Model", bound=BaseModel)

_SHOWN = 60
"""Characters of a wrong value shown in a message: enough to find it, and still one line."""


class TomlTable(BaseModel):
    """A table of a TOML file: its keys are fixed, unknown ones are refused, and it never changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


def one_of(names: Collection[str]) -> AfterValidator:
    """Return the check of a key that says one of these names."""

    def known(name: str) -> str:
        if name not in names:
            raise ValueError(f"must be one of {', '.join(names)}")
        return name

    return AfterValidator(known)


def read_toml_text(path: Path, error: type[UserError]) -> str:
    """Return the text of a TOML file; raise ``error``, one line, if it can't be read."""
    try:
        return path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as cause:
        reason = cause.strerror if isinstance(cause, OSError) else "it is not UTF-8 text"
        raise error(f"{path}: can't be read, {reason}: name a TOML file") from cause


def read_shipped_or_named(
    name_or_file: str | Path, what: str, folder: str, shipped: Sequence[str], error: type[UserError]
) -> str:
    """Return the text of a shipped TOML file, by its name in a package's folder, or of any TOML file, by its path.

    Raise ``error``, one line that says ``what`` was looked for and what there is, if there is none or it can't be read.
    """
    name = str(name_or_file)
    if name in shipped:
        package, _, inside = folder.rpartition(".")
        return (resources.files(package) / inside / f"{name}.toml").read_text("utf-8")
    if not Path(name).is_file():
        meant = f"; did you mean {name}.toml?" if Path(f"{name}.toml").is_file() else ""
        raise error(f"no {what} {name!r}: name one of {', '.join(shipped)}, or a TOML file that exists{meant}")
    return read_toml_text(Path(name), error)


def parse_document(text: str, source: str, error: type[UserError]) -> tomlkit.TOMLDocument:
    """Return a TOML text with its comments; raise ``error``, one line that names ``source``, if it isn't TOML."""
    try:
        return tomlkit.parse(text)
    except TOMLKitError as cause:
        raise error(f"{source}: {_broken_toml(text, cause)}") from cause


def _broken_toml(text: str, cause: TOMLKitError) -> str:
    """Return what is wrong with a text that isn't TOML, and what to do. A NUL stands for the end of the text."""
    if "\\x00" in str(cause) and "\0" not in text:
        return f"not TOML, it ends in the middle of line {len(text.splitlines())}: write the rest of it"
    return f"not TOML ({cause}): mend that line"


def parse_toml(model: type[Model], text: str, source: str, error: type[UserError]) -> Model:
    """Return the model that a TOML text describes.

    Raise ``error``, one line with ``source`` and the key, if it doesn't fit.
    """
    tables = parse_document(text, source, error).unwrap()
    try:
        # Through JSON, since TOML's arrays are lists, and strict tuples accept lists only from JSON.
        return model.model_validate_json(json.dumps(tables, default=str))
    except ValidationError as cause:
        mistakes = cause.errors()
        # A misspelt key is unknown, and what was meant is missing: the first says more.
        unknown = [mistake for mistake in mistakes if mistake["type"] == "extra_forbidden"]
        raise error(f"{source}: {_in_one_line(model, (unknown or mistakes)[0])}") from cause


def table_of_key(model: type[BaseModel], key: str) -> type[BaseModel] | None:
    """Return the model of the table, or of the tables, under a key.

    Return None if the key holds something else, or is unknown.
    """
    field = model.model_fields.get(key)
    kinds = (field.annotation, *get_args(field.annotation)) if field else ()
    return next((each for each in kinds if isinstance(each, type) and issubclass(each, BaseModel)), None)


def _in_one_line(model: type[BaseModel], mistake: ErrorDetails) -> str:
    key = ".".join(str(part) for part in mistake["loc"]) or "the file"
    if mistake["type"] == "extra_forbidden":
        return f"{key}: unknown key: {_remedy_for_unknown(model, mistake['loc'])}"
    if mistake["type"] == "missing":
        return f"{key}: missing: add it"
    if mistake["type"] == "model_type":
        return f"{key}: must be a table: write [{key}] and its keys below"
    if mistake["type"] == "value_error":
        return f"{key}: {mistake['ctx']['error']}"
    return f"{key}: {mistake['msg']}, not {_shortened(mistake['input'])}: mend that key"


def _remedy_for_unknown(model: type[BaseModel], keys: tuple[int | str, ...]) -> str:
    kind: type[BaseModel] | None = model
    for key in (part for part in keys[:-1] if isinstance(part, str)):
        if kind and key in kind.model_fields:  # else it is the name of one of several tables
            kind = table_of_key(kind, key)
    known = list(kind.model_fields) if kind else []
    near = difflib.get_close_matches(str(keys[-1]), known, n=1)
    return f"did you mean {near[0]}?" if near else f"remove it; known are {', '.join(known)}"


def _shortened(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
