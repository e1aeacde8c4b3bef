"""A scenario from one layer of a volume.

As on a map, with north on top: the volume's north is the arena's far edge, its east the right. All blocks of the layer
become the design, of one material, which the main agent chooses; what they were made of is only told.

The cells that have blocks are put into the middle of an arena of 15 x 15 cells, or of as many as they need, up to 32 x
32: 32 cells across and 31 along, since no block can land on the near edge. A larger layer is cut to its middle. The
start cell is the far edge's middle; materials and step limit are as in a benchmark (arena/design.py).
"""

from collections import Counter
from dataclasses import replace

import numpy as np

from mc_nested.arena.action import LARGEST_SIZE, Cell
from mc_nested.arena.design import scenario_of_design
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arena.scenario_file import LONGEST_NAME, load_scenario
from mc_nested.arrays import Bools
from mc_nested.design_files.volume import Volume
from mc_nested.errors import ScenarioError

MOST_ACROSS, MOST_ALONG = LARGEST_SIZE, LARGEST_SIZE - 1
"""Cells of a design at most: none of its blocks can be on the near edge."""

LIKE = "line"
"""The shipped scenario whose materials are taken."""

KINDS_TOLD = 3


def scenario_of_layer(name: str, volume: Volume, layer: int) -> tuple[Scenario, list[str]]:
    """Return the scenario of a layer, and what a person should know about it, a line each, without the file's name.

    ScenarioError, without the file's name, if the layer has no block, or none that is kept.
    """
    trimmed = _trimmed(volume.filled(layer))
    kept = _trimmed(_middle(trimmed))
    if not kept.size:
        raise ScenarioError(
            f"layer {layer} has no block in its middle {MOST_ACROSS} x {MOST_ALONG} cells, and an arena has room "
            "for no more: make the design smaller"
        )
    length, width = kept.shape
    size = max(DEFAULT_SIZE, width, length + 1)
    design = _centred(kept, size)
    like = replace(load_scenario(LIKE), design=design, size=size, start=(size // 2, size - 1))
    scenario = scenario_of_design(_scenario_name(name, volume, layer), design, like)
    if scenario is None:
        raise ScenarioError(f"layer {layer} can't be built by the scripted builder: change the design")
    return scenario, _notes(volume, layer, trimmed, len(design))


def kinds_in_words(kinds: Counter[str]) -> str:
    """Return ``12 stone, 8 oak_planks, 5 others``: blocks by how many there are, at most so many kinds by name."""
    common = kinds.most_common(KINDS_TOLD)
    named = [f"{count} {name}" for name, count in common]
    others = kinds.total() - sum(count for _, count in common)
    return ", ".join([*named, f"{others} others"] if others else named)


def _notes(volume: Volume, layer: int, trimmed: Bools, kept: int) -> list[str]:
    notes = []
    kinds = volume.kinds(layer)
    if len(kinds) > 1:
        notes.append(f"its blocks are built of one material: {kinds_in_words(kinds)}")
    if kept < kinds.total():
        length, width = trimmed.shape
        notes.append(
            f"{width} x {length} cells have blocks, and an arena has room for {MOST_ACROSS} x {MOST_ALONG}: only the "
            f"middle is kept; {kinds.total() - kept} of {kinds.total()} blocks, around it, are cut off"
        )
    return notes


def _trimmed(filled: Bools) -> Bools:
    """Return the smallest part that holds every block, of no cell if there is none."""
    rows, columns = np.flatnonzero(filled.any(axis=1)), np.flatnonzero(filled.any(axis=0))
    if not len(rows):
        return filled[:0, :0]
    return filled[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def _middle(filled: Bools) -> Bools:
    """Return as much of the middle as an arena has room for."""
    length, width = filled.shape
    top, left = max(0, (length - MOST_ALONG) // 2), max(0, (width - MOST_ACROSS) // 2)
    return filled[top : top + MOST_ALONG, left : left + MOST_ACROSS]


def _centred(filled: Bools, size: int) -> frozenset[Cell]:
    """Return the blocks in the middle of an arena.

    Where they can't be, they stand one cell nearer to the left and to the far edge.
    """
    length, width = filled.shape
    left, top = (size - width) // 2, (size - length) // 2
    return frozenset((left + int(x), size - 1 - top - int(row)) for row, x in np.argwhere(filled))


def _scenario_name(name: str, volume: Volume, layer: int) -> str:
    """Return the file's name, with the layer's number if there are several; without what can't be printed."""
    ending = f"-{layer}" if volume.layers > 1 else ""
    printable = "".join(character for character in name if character.isprintable()).strip()
    return (printable[: LONGEST_NAME - len(ending)] or "design") + ending
