"""Reading the project's TOML files: scenarios, presets and profiles, each a pydantic model, each mistake one line."""

from pathlib import Path
from typing import TypeVar

import tomlkit
from pydantic import BaseModel, ValidationError
from tomlkit.exceptions import TOMLKitError

from mc_nested.errors import UserError

Model = TypeVar("Model", bound=BaseModel)


def read_toml_text(path: Path, error: type[UserError]) -> str:
    """The text of a TOML file; ``error``, one line, where it can't be read."""
    try:
        return path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as cause:
        reason = cause.strerror if isinstance(cause, OSError) else "it is not UTF-8 text"
        raise error(f"{path}: can't be read, {reason}: name a TOML file") from cause


def parse_toml(model: type[Model], text: str, source: str, error: type[UserError]) -> Model:
    """The model that a TOML text describes; ``error``, one line that names ``source`` and the key, where it doesn't."""
    try:
        return model.model_validate(tomlkit.parse(text).unwrap())
    except TOMLKitError as cause:
        raise error(f"{source}: not TOML ({cause}): mend that line") from cause
    except ValidationError as cause:
        first = cause.errors()[0]
        key = ".".join(str(part) for part in first["loc"])
        raise error(f"{source}: {key}: {first['msg']}: mend that key") from cause
