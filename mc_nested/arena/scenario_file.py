"""Scenario files: TOML with the design as an ASCII grid, the far edge (y = 14) on top."""

from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import SIZE, is_inside
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.errors import ScenarioError
from mc_nested.toml_file import parse_toml, read_shipped_or_named

BLOCK, FREE = "#", "."

LARGEST_P, LONGEST = 1_000_000.0, 100_000
"""The largest absolute p, and the highest step limit: 32-bit floats hold every score, and episodes end in time."""

Name = Annotated[str, Field(min_length=1, max_length=60, pattern=r"^\P{C}+$")]
"""A name of one line: no control characters."""


class MaterialTable(BaseModel):
    """A material in a scenario file."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    name: Name
    p: Annotated[float, Field(ge=-LARGEST_P, le=LARGEST_P)]
    block: Annotated[str, Field(pattern=r"^[a-z0-9_]+$")]


class ScenarioTable(BaseModel):
    """A scenario file."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)
    name: Name
    start: Annotated[list[int], Field(min_length=2, max_length=2)]
    step_limit: Annotated[int, Field(ge=1, le=LONGEST)]
    design: str
    materials: Annotated[list[MaterialTable], Field(min_length=1)]


def shipped_scenarios() -> list[str]:
    """Names of the scenarios that come with the project, easiest first."""
    return ["line", "zigzag", "diamond"]


def load_scenario(name_or_file: str | Path) -> Scenario:
    """The scenario of a shipped name or of a TOML file; ScenarioError, one line if it can't be used."""
    shipped = shipped_scenarios()
    text = read_shipped_or_named(name_or_file, "scenario", "mc_nested.arena.designs", shipped, ScenarioError)
    return parse_scenario(text, str(name_or_file))


def parse_scenario(text: str, source: str) -> Scenario:
    """The scenario that a TOML text describes; ``source`` names it in errors."""
    return scenario_of(parse_toml(ScenarioTable, text, source, ScenarioError), source)


def scenario_of(table: ScenarioTable, source: str) -> Scenario:
    """The scenario of a table; ScenarioError, one line that names ``source``, if it can't be built."""
    scenario = Scenario(
        name=table.name,
        design=_parse_grid(table.design, source),
        start=(table.start[0], table.start[1]),
        step_limit=table.step_limit,
        materials=tuple(Material(m.name, m.p, m.block) for m in table.materials),
    )
    _check(scenario, source)
    return scenario


def table_of(scenario: Scenario) -> ScenarioTable:
    """The scenario as a table: what ``scenario_of`` reads back."""
    return ScenarioTable(
        name=scenario.name,
        start=list(scenario.start),
        step_limit=scenario.step_limit,
        design=draw_grid(scenario.design),
        materials=[MaterialTable(name=m.name, p=m.p, block=m.block) for m in scenario.materials],
    )


def draw_grid(cells: frozenset[Cell]) -> str:
    """The cells as the ASCII grid of a scenario file, the far edge (y = 14) on top."""
    rows = ("".join(BLOCK if (x, y) in cells else FREE for x in range(SIZE)) for y in reversed(range(SIZE)))
    return "".join(row + "\n" for row in rows)


def _parse_grid(grid: str, source: str) -> frozenset[Cell]:
    rows = grid.split()
    if len(rows) != SIZE or any(len(row) != SIZE or set(row) - {BLOCK, FREE} for row in rows):
        raise ScenarioError(
            f"{source}: design: write {SIZE} rows of {SIZE} characters, {BLOCK!r} for a block and {FREE!r} for none"
        )
    return frozenset(
        (x, SIZE - 1 - row) for row, line in enumerate(rows) for x, character in enumerate(line) if character == BLOCK
    )


def _check(scenario: Scenario, source: str) -> None:
    if not scenario.design:
        raise ScenarioError(f"{source}: design: has no block ({BLOCK!r}): draw at least one")
    # A block lands in front of the agent (y + 1), so the cells of the near edge can't be reached from inside the arena.
    # All other cells can be built, even all of them together: farthest row first.
    unreachable = sorted(cell for cell in scenario.design if cell[1] == 0)
    if unreachable:
        raise ScenarioError(
            f"{source}: design: cell {unreachable[0]} can't be reached, a block lands in front of the agent: "
            f"keep the bottom row free"
        )
    if not is_inside(scenario.start):
        raise ScenarioError(f"{source}: start: {scenario.start} lies outside: choose 0 to {SIZE - 1} for x and y")
    if scenario.step_limit < scenario.blocks:
        raise ScenarioError(
            f"{source}: step_limit: {scenario.step_limit} steps can't place {scenario.blocks} blocks: raise it"
        )
    names = [material.name for material in scenario.materials]
    if len(set(names)) != len(names):
        raise ScenarioError(f"{source}: materials: two have the same name: rename one")
