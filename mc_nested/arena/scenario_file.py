"""Scenario files: TOML with the design as an ASCII grid, the far edge on top.

The drawing's size is the arena's: N rows of N characters make an arena of N x N cells. A part is drawn in the same way.
"""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from mc_nested.arena.action import LARGEST_SIZE, SMALLEST_SIZE, Cell
from mc_nested.arena.builder import order_of_parts, out_of_reach, within_reach
from mc_nested.arena.scenario import Material, Part, Scenario
from mc_nested.errors import ScenarioError
from mc_nested.toml_file import TomlTable, parse_toml, read_shipped_or_named

BLOCK, FREE = "#", "."

LARGEST_P, LONGEST = 1_000_000.0, 100_000
"""The largest absolute p, and the highest step limit: 32-bit floats hold every score, and episodes end in time."""

LONGEST_NAME = 60

Name = Annotated[str, Field(min_length=1, max_length=LONGEST_NAME, pattern=r"^\P{C}+$")]
"""A name of one line: no control characters."""


Worth = Annotated[float, Field(ge=-LARGEST_P, le=LARGEST_P)]


class MaterialTable(TomlTable):
    """A material in a scenario file: one that the main agent can choose."""

    name: Name = Field(description="what it is called: each has a name of its own")
    p: Worth = Field(description="what choosing it adds to the episode's score")
    block: Annotated[str, Field(pattern=r"^[a-z0-9_]+$")] = Field(
        description="its block, as Minecraft 1.13 and later name it, without namespace: stone, oak_planks"
    )


class PartTable(TomlTable):
    """A part in a scenario file: they are built in the order in which they stand there."""

    cells: str = Field(
        description="the drawing of the part's cells, as large as the design's: each cell of the design is in one part"
    )
    worth: dict[str, Worth] = Field(
        default={},
        description="what each material is worth in this part, by its name; the p of those that aren't named is that "
        "of their own table",
    )


class ScenarioTable(TomlTable):
    """A scenario file."""

    name: Name = Field(description="what the scenario is called")
    start: Annotated[list[int], Field(min_length=2, max_length=2)] = Field(
        description="the cell where each episode begins, as x, y: counted from 0 at the near left corner"
    )
    step_limit: Annotated[int, Field(ge=1, le=LONGEST)] = Field(
        description="the most steps of an episode; at least as many as the design has blocks"
    )
    design: str = Field(
        description="the drawing: # is a block, . is none, the far edge on top; N rows of N characters make an arena "
        "of N x N cells, 5 to 32; the bottom row stays free, since a block lands in front of the agent"
    )
    materials: Annotated[list[MaterialTable], Field(min_length=1)] = Field(
        description="what can be built of, a table each"
    )
    parts: list[PartTable] = Field(
        default=[],
        description="for a design that is built in parts, a table each: the main agent chooses a material for each",
    )
    choose_every: Annotated[int, Field(ge=1, le=LONGEST)] | None = Field(
        default=None, description="with parts: the main agent chooses again after so many steps within a part, too"
    )
    regions: bool = Field(
        default=False,
        exclude_if=lambda has_regions: not has_regions,  # checkpoints from before there were any still fit
        description="with parts: each material stands for one of as many regions of the arena, from the near left one "
        "on; a block pays the nested agent in the chosen one alone, and after each the main agent chooses again",
    )


def paper_scenarios() -> list[str]:
    """Return the names of the paper's three scenarios, easiest first; experiments run them unless others are named."""
    return ["line", "zigzag", "diamond"]


def shipped_scenarios() -> list[str]:
    """List the scenarios that come with the project: the paper's, a scattered and two larger ones, one in parts."""
    return [*paper_scenarios(), "islands", "house", "square", "flag"]


def load_scenario(name_or_file: str | Path, *, must_reach: bool = True) -> Scenario:
    """Return the scenario of a shipped name or of a TOML file; ScenarioError, one line if it can't be used.

    Without ``must_reach``, some cells of its design may be out of reach (builder.within_reach).
    """
    shipped = shipped_scenarios()
    text = read_shipped_or_named(name_or_file, "scenario", "mc_nested.arena.designs", shipped, ScenarioError)
    return parse_scenario(text, str(name_or_file), must_reach=must_reach)


def parse_scenario(text: str, source: str, *, must_reach: bool = True) -> Scenario:
    """Return the scenario that a TOML text describes; ``source`` names it in errors."""
    return scenario_of(parse_toml(ScenarioTable, text, source, ScenarioError), source, must_reach=must_reach)


def scenario_of(table: ScenarioTable, source: str, *, must_reach: bool = True) -> Scenario:
    """Return the scenario of a table; ScenarioError, one line that names ``source``, if it can't be built.

    Without ``must_reach``, it can be built if any of its cells can.
    """
    design, size = _parse_grid(table.design, f"{source}: design")
    parts = tuple(_part_of(part, number, table, source) for number, part in enumerate(table.parts, 1))
    try:
        scenario = Scenario(
            name=table.name,
            design=design,
            start=(table.start[0], table.start[1]),
            step_limit=table.step_limit,
            materials=tuple(Material(m.name, m.p, m.block) for m in table.materials),
            size=size,
            parts=parts,
            choose_every=table.choose_every,
            regions=table.regions,
        )
    except ScenarioError as error:
        raise ScenarioError(f"{source}: {error}") from None
    _check(scenario, source, must_reach=must_reach)
    return scenario


def table_of(scenario: Scenario) -> ScenarioTable:
    """Return the scenario as a table: what ``scenario_of`` reads back."""
    return ScenarioTable(
        name=scenario.name,
        start=list(scenario.start),
        step_limit=scenario.step_limit,
        design=draw_grid(scenario.design, scenario.size),
        materials=[MaterialTable(name=m.name, p=m.p, block=m.block) for m in scenario.materials],
        parts=[
            PartTable(
                cells=draw_grid(part.cells, scenario.size),
                worth={m.name: p for m, p in zip(scenario.materials, part.worth, strict=True)},
            )
            for part in scenario.parts
        ],
        choose_every=scenario.choose_every,
        regions=scenario.regions,
    )


def draw_grid(cells: frozenset[Cell], size: int) -> str:
    """Return the cells as the ASCII grid of a scenario file: ``size`` rows, the far edge on top."""
    rows = ("".join(BLOCK if (x, y) in cells else FREE for x in range(size)) for y in reversed(range(size)))
    return "".join(row + "\n" for row in rows)


def _part_of(part: PartTable, number: int, table: ScenarioTable, source: str) -> Part:
    where = f"{source}: parts: part {number}"
    cells, size = _parse_grid(part.cells, where)
    if size != len(table.design.split()):
        raise ScenarioError(f"{where}: {size} rows, and the design has {len(table.design.split())}: draw as many")
    unknown = sorted(part.worth.keys() - {material.name for material in table.materials})
    if unknown:
        raise ScenarioError(f"{where}: there is no material {unknown[0]!r}: name one of [[materials]]")
    return Part(cells, tuple(part.worth.get(material.name, material.p) for material in table.materials))


def _parse_grid(grid: str, where: str) -> tuple[frozenset[Cell], int]:
    """Return the cells of a drawing, and how many it has along each side; ``where`` it is, for errors."""
    rows = grid.split()
    size = len(rows)
    for number, row in enumerate(rows, 1):
        if set(row) - {BLOCK, FREE}:
            raise ScenarioError(f"{where}: row {number} is {row!r}: write {BLOCK!r} for a block and {FREE!r} for none")
        if len(row) != size:
            raise ScenarioError(
                f"{where}: {size} rows, and row {number} has {len(row)} characters: draw a square, "
                f"{SMALLEST_SIZE} to {LARGEST_SIZE} rows of as many characters"
            )
    cells = frozenset(
        (x, size - 1 - row) for row, line in enumerate(rows) for x, character in enumerate(line) if character == BLOCK
    )
    return cells, size


def _check(scenario: Scenario, source: str, *, must_reach: bool) -> None:
    if not scenario.design:
        raise ScenarioError(f"{source}: design: has no block ({BLOCK!r}): draw at least one")
    # A block lands in front of the agent (y + 1), so the cells of the near edge can't be reached from inside the arena.
    # All other cells can be built, even all of them together: farthest row first.
    unreachable, buildable = sorted(out_of_reach(scenario)), within_reach(scenario)
    if unreachable and (must_reach or not buildable.design):
        raise ScenarioError(
            f"{source}: design: cell {unreachable[0]} can't be reached, a block lands in front of the agent: "
            f"keep the bottom row free"
        )
    if scenario.step_limit < buildable.blocks:
        raise ScenarioError(
            f"{source}: step_limit: {scenario.step_limit} steps can't place {buildable.blocks} blocks: raise it"
        )
    names = [material.name for material in scenario.materials]
    if len(set(names)) != len(names):
        raise ScenarioError(f"{source}: materials: two have the same name: rename one")
    for name in ("choose_every", "regions"):
        if getattr(scenario, name) and not scenario.parts:
            raise ScenarioError(f"{source}: {name}: goes with [[parts]]: draw the design in one part, or in several")
    if scenario.parts and order_of_parts(buildable) is None:
        raise ScenarioError(
            f"{source}: parts: what is built first shuts off a cell of a later part: change their order, or the design"
        )
