"""Preset: every number of a training that is not the task's, as a TOML file that pydantic checks."""

from importlib import resources
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from mc_nested.errors import PresetError
from mc_nested.toml_file import parse_toml, read_shipped_or_named

MOST = 1_000_000_000
"""The highest count of anything: fits 32 bits, and no training comes near it."""

WIDEST, DEEPEST, LARGEST_BATCH = 4096, 16, 4096
"""The largest networks and batches: a slip of the pen beyond them would eat the machine's memory first."""

Count = Annotated[int, Field(ge=1, le=MOST)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(gt=0, le=1)]
Probability = Annotated[float, Field(ge=0, le=1)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Exploration(_Table):
    """ε from ``start`` to ``floor`` over the first ``share`` of the episodes."""

    start: Probability
    floor: Probability
    share: Share


class Update(_Table):
    """What an update of either agent does, and from how many transitions on there are updates."""

    batch: Annotated[int, Field(ge=1, le=LARGEST_BATCH)]
    learning_starts: Count
    learning_rate: Positive
    gamma: Probability
    target_period: Count
    huber_delta: Positive


class Preset(_Table):
    """A training's hyper-parameters; ``paper`` is README's table."""

    episodes: Count
    evaluate_every: Count
    hidden: Annotated[list[Annotated[int, Field(ge=1, le=WIDEST)]], Field(min_length=1, max_length=DEEPEST)]
    replay_capacity: Count
    update: Update
    explore_main: Exploration
    explore_nested: Exploration


def shipped_presets() -> list[str]:
    """Names of the presets that come with the project."""
    folder = resources.files("mc_nested.learn") / "presets"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


def load_preset(name_or_file: str | Path) -> Preset:
    """The preset of a shipped name or of a TOML file; PresetError, one line, where it can't be used."""
    shipped = shipped_presets()
    text = read_shipped_or_named(name_or_file, "preset", "mc_nested.learn.presets", shipped, PresetError)
    return parse_preset(text, str(name_or_file))


def parse_preset(text: str, source: str) -> Preset:
    """The preset that a TOML text describes; ``source`` names it in errors."""
    return parse_toml(Preset, text, source, PresetError)
