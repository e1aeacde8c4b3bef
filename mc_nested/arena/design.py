"""What a design is by itself: how its blocks are joined, and its scenario, with a step limit by one rule.

The blocks are joined by their edges, by edges and corners, or not at all. All else comes from another scenario.

Random designs of one layer, which nobody drew, are a pure function of a seed and a number. The kinds take turns, so
that every kind has an equal share. The number of blocks is drawn first, each equally likely.

Corpus files hold many designs in one TOML file, each a name and a drawing:

    [[designs]]
    name = "house"
    design = '''
    ..#..
    .#.#.
    #####
    '''

A row of text is a row of the arena, the far edge on top: ``#`` is a block, ``.`` none. Rows are of equal length. A
drawing smaller than the arena is centred; where it can't be in the very middle it stands one cell nearer to the left
and to the far edge. Start cell and materials are those of the shipped designs.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace
from math import ceil
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build, out_of_reach
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arena.scenario_file import BLOCK, FREE, Name
from mc_nested.errors import ScenarioError
from mc_nested.toml_file import TomlTable, parse_toml, read_toml_text

EDGE, CORNER, SCATTERED = "edge", "corner", "scattered"

KINDS = (EDGE, CORNER, SCATTERED)
"""Every kind; a design is of exactly one."""

BESIDE: Sequence[Cell] = ((0, 1), (0, -1), (-1, 0), (1, 0))
"""Steps to the cells that share an edge."""

DIAGONAL: Sequence[Cell] = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""Steps to the cells that share only a corner."""


def kind_of_design(design: Collection[Cell]) -> str:
    """Return the kind of a design of at least one block.

    ``edge``: every block is reached from every other over shared edges. ``corner``: over edges and corners, but not
    over edges alone, like the zigzag and the diamond. ``scattered``: not even over corners.
    """
    if _is_connected(design, BESIDE):
        return EDGE
    return CORNER if _is_connected(design, (*BESIDE, *DIAGONAL)) else SCATTERED


def neighbours(cell: Cell, steps: Sequence[Cell]) -> list[Cell]:
    """Return the cells that those steps lead to, inside the arena or not."""
    return [(cell[0] + right, cell[1] + forward) for right, forward in steps]


def _is_connected(design: Collection[Cell], steps: Sequence[Cell]) -> bool:
    first = next(iter(design))
    reached, ends = {first}, [first]
    while ends:
        found = [cell for cell in neighbours(ends.pop(), steps) if cell in design and cell not in reached]
        reached.update(found)
        ends += found
    return len(reached) == len(set(design))


FEWEST_STEPS = 60
"""The shipped designs' limit, and the lowest."""

BUILDERS_STEPS = 1.5
"""The limit of a design that takes longer, in steps of the scripted builder."""


def scenario_of_design(name: str, design: frozenset[Cell], like: Scenario) -> Scenario | None:
    """Return a scenario with that design, its start cell and materials those of ``like``.

    The step limit is 60, or one and a half times what the scripted builder takes, whichever is more. None if the
    builder can't build the design within it.
    """
    scenario = replace(like, name=name, design=design)
    limit = max(FEWEST_STEPS, ceil(BUILDERS_STEPS * len(build(scenario))))
    scenario = replace(scenario, step_limit=limit)
    return scenario if is_buildable(scenario) else None


def is_buildable(scenario: Scenario) -> bool:
    """Return whether the scripted builder builds exactly the design within the step limit."""
    return not out_of_reach(scenario) and len(build(scenario)) <= scenario.step_limit


FEW_BLOCKS = 5, 20
"""The fewest blocks of a design, and the most, unless others are asked for."""

GROWS_BY = {EDGE: BESIDE, CORNER: DIAGONAL}
"""Where the next block of a design that grows may stand, beside any of its blocks; scattered blocks stand anywhere."""


def random_scenario(seed: int, number: int, like: Scenario, blocks: tuple[int, int] = FEW_BLOCKS) -> Scenario:
    """Return design ``number`` of that seed; arena, start cell and materials are those of ``like``.

    ``blocks`` are the fewest that it may have, and the most.

    Drawn again until it is of its kind, and the scripted builder builds it within its step limit.
    """
    kind = KINDS[number % len(KINDS)]
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(number,))))
    while True:
        design = draw_design(kind, random, like.size, blocks)
        scenario = scenario_of_design(f"{kind}-{number:03d}", design, like)
        if kind_of_design(design) == kind and scenario:
            return scenario


def draw_design(kind: str, random: np.random.Generator, size: int, blocks: tuple[int, int]) -> frozenset[Cell]:
    """Return blocks of that kind, but scattered ones may touch by chance; from the fewest to the most.

    No block lies on the near edge, where none can land.
    """
    fewest, most = blocks
    wanted = int(random.integers(fewest, most + 1))
    cells = [(x, y) for x in range(size) for y in range(1, size)]
    if kind not in GROWS_BY:
        return frozenset(cells[place] for place in random.permutation(len(cells))[:wanted])
    return _grown(wanted, GROWS_BY[kind], cells, random)


def _grown(blocks: int, steps: Sequence[Cell], cells: Sequence[Cell], random: np.random.Generator) -> frozenset[Cell]:
    """Grow from one cell, each time into any free cell that is one of the steps away from a block."""
    design = {cells[int(random.integers(len(cells)))]}
    inside = set(cells)
    while len(design) < blocks:
        free = sorted({near for cell in design for near in neighbours(cell, steps) if near in inside} - design)
        design.add(free[int(random.integers(len(free)))])
    return frozenset(design)


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
