"""The reference of TOML files: every key of the shipped kinds, with a meaning, and limits in words."""

from typing import Annotated, Literal

import pytest
from pydantic import BaseModel, Field

from mc_nested.arena.scenario_file import ScenarioTable
from mc_nested.learn.preset import Preset
from mc_nested.live.profile.tables import Profile
from scripts.documentation.table_reference import markdown


class Below(BaseModel):
    """What lies ``below``."""

    speed: float = Field(default=0.5, gt=0, le=60, description="how fast")
    corner: tuple[int, int] = Field(description="where, as x, y")
    deeper: "Deeper" = Field(description="what lies deeper")


class Deeper(BaseModel):
    depth: int


class Whole(BaseModel):
    name: str = Field(description="what it is called")
    kind: Literal["one", "two"] = Field(default="one", description="which")
    sizes: Annotated[list[Annotated[int, Field(ge=1, le=4096)]], Field(min_length=1)] = Field(
        default=[3], description="how large"
    )
    points: dict[str, float] = Field(default_factory=dict, description="places")
    below: Below
    maybe: Below | None = None


def test_keys_are_listed_with_their_type_limits_and_default() -> None:
    page = markdown(Whole)
    assert "| `name` | text | must be there | What it is called. |" in page
    assert '| `kind` | `"one"`, `"two"` | `"one"` | Which. |' in page
    assert "| `sizes` | list of 1 or more: whole number, 1 to 4,096 | `[3]` | How large. |" in page
    assert "## [points]\n\nPlaces. Each key is number.\n" in page
    assert "## [below]\n\nWhat lies `below`.\n\n| key |" in page
    assert "## [maybe]\n\nWhat lies `below`.\n\nThis table may be left out.\n\n| key |" in page
    assert "| `speed` | number, above 0 and up to 60 | `0.5` | How fast. |" in page
    assert "| `deeper` | a table of the keys of [deeper] | must be there | What lies deeper. |" in page
    assert "| `corner` | list of 2: whole number | must be there | Where, as x, y. |" in page


@pytest.mark.parametrize("model", [Profile, Preset, ScenarioTable], ids=lambda model: model.__name__)
def test_every_key_of_a_shipped_kind_has_a_meaning(model: type[BaseModel]) -> None:
    page = markdown(model)
    without = [line for line in page.splitlines() if line.startswith("| `") and line.endswith("|  |")]
    assert without == []
    for name, field in model.model_fields.items():
        assert f"`{name}`" in page or f"[{name}]" in page, (name, field)
