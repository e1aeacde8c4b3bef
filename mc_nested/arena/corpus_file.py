"""Corpus files: many designs in one TOML file, each a name and a drawing.

    [[designs]]
    name = "house"
    design = '''
    ..#..
    .#.#.
    #####
    '''

A row of text is a row of the arena, the far edge on top: ``#`` is a block, ``.`` none. Rows are of equal length. A
drawing smaller than the arena is centred; where it can't be in the very middle it stands one cell nearer to the left
and to the far edge. Start cell and materials are those of the shipped designs, the step limit follows one rule
(design.py).
"""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from mc_nested.arena.action import Cell
from mc_nested.arena.design import scenario_of_design
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arena.scenario_file import BLOCK, FREE, Name
from mc_nested.errors import ScenarioError
from mc_nested.toml_file import TomlTable, parse_toml, read_toml_text

MOST_DESIGNS = 1000
"""Designs of a corpus: more would take days."""


class _Drawing(TomlTable):
    name: Name
    design: str


class _Corpus(TomlTable):
    designs: Annotated[list[_Drawing], Field(min_length=1, max_length=MOST_DESIGNS)]


def load_corpus(path: Path, like: Scenario) -> list[Scenario]:
    """Return the file's designs as scenarios, in their order; start cell and materials are those of ``like``.

    ScenarioError, one line that names the file and the design, if one can't be used.
    """
    return parse_corpus(read_toml_text(path, ScenarioError), str(path), like)


def parse_corpus(text: str, source: str, like: Scenario) -> list[Scenario]:
    """Return the designs of a TOML text; ``source`` names it in errors."""
    drawings = parse_toml(_Corpus, text, source, ScenarioError).designs
    names = [drawing.name for drawing in drawings]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise ScenarioError(f"{source}: two designs are named {twice!r}: rename one")
    scenarios = []
    for drawing in drawings:
        where = f"{source}: design {drawing.name!r}"
        scenario = scenario_of_design(drawing.name, _centred(drawing.design, where), like)
        if scenario is None:
            raise ScenarioError(f"{where}: the scripted builder can't build it: draw another")
        scenarios.append(scenario)
    return scenarios


def _centred(drawing: str, where: str) -> frozenset[Cell]:
    """Return the drawing's blocks in the middle of the arena; ScenarioError if it doesn't fit, or can't be built."""
    rows = drawing.split()
    width = len(rows[0]) if rows else 0
    if not rows or any(len(row) != width or set(row) - {BLOCK, FREE} for row in rows):
        raise ScenarioError(
            f"{where}: not a design: write rows of equal length, {BLOCK!r} for a block and {FREE!r} for none"
        )
    if width > DEFAULT_SIZE or len(rows) > DEFAULT_SIZE:
        raise ScenarioError(
            f"{where}: {width} x {len(rows)} cells are more than the arena's {DEFAULT_SIZE} x {DEFAULT_SIZE}: "
            "draw it smaller"
        )
    left, top = (DEFAULT_SIZE - width) // 2, (DEFAULT_SIZE - len(rows)) // 2
    cells = frozenset(
        (left + x, DEFAULT_SIZE - 1 - top - row)
        for row, line in enumerate(rows)
        for x, character in enumerate(line)
        if character == BLOCK
    )
    if not cells:
        raise ScenarioError(f"{where}: has no block ({BLOCK!r}): draw at least one")
    if any(y == 0 for _, y in cells):
        raise ScenarioError(
            f"{where}: its bottom row can't be reached, a block lands in front of the agent: keep that row free"
        )
    return cells
