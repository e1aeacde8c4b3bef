"""``mc-nested scenarios``: the designs as drawings, with their optimum and the fewest steps; a file's layers."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console, Group
from rich.text import Text

from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Part, Scenario
from mc_nested.arena.scenario_file import draw_grid, shipped_scenarios
from mc_nested.arena.search import EXACT_UP_TO, fewest_steps
from mc_nested.cli.completion import complete_of
from mc_nested.cli.options import LayerOption, named_scenario, print_notes
from mc_nested.cli.output import JsonOption, Output, prints
from mc_nested.design_files.layer_scenario import kinds_in_words
from mc_nested.design_files.load import is_design_file, load_layer, read_volume
from mc_nested.design_files.volume import Volume
from mc_nested.report.terminal import arena_view

MOST_LISTED = 100
"""Layers of a file that are listed."""


@dataclass(frozen=True)
class ScenarioList:
    """What ``scenarios`` prints."""

    scenarios: Annotated[
        Sequence[object],
        "of each: name, size, blocks, materials, optimum, fewest_steps (is_exact: by search), builder_steps, "
        "step_limit, parts (cells as rows, worth by material), choose_every (None: once a part), regions (whether "
        "the materials are some) and the design as rows, the far edge first",
    ]


@prints(ScenarioList)
def scenarios(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME|FILE]...",
            help="which",
            show_default="all that are shipped",
            autocompletion=complete_of(shipped_scenarios),
        ),
    ] = None,
    layer: LayerOption = None,
    as_json: JsonOption = False,
) -> None:
    """List the designs with a drawing, the optimum and the fewest steps; of a schematic its layers, too."""
    if as_json:
        found = [_fields(named_scenario(name, layer)) for name in names or shipped_scenarios()]
        Output(as_json=True).result(ScenarioList(found))
        return
    console = Console()
    for name in names or shipped_scenarios():
        console.print(_facts(_shown(name, layer, console)))
        console.print()


def _shown(name: str, layer: int | None, console: Console) -> Scenario:
    """Return the scenario of a name or file; of a file with several layers these are printed first."""
    if not is_design_file(name):
        return named_scenario(name, layer)
    volume = read_volume(Path(name))
    loaded = load_layer(Path(name), volume, layer)
    if volume.layers > 1:
        console.print(_layers(Path(name).name, volume))
    print_notes(loaded)
    return loaded.scenario


def _layers(name: str, volume: Volume) -> Group:
    """Return the layers that have blocks: how many, over how many cells, and of what."""
    filled = volume.layers_with_blocks()
    lines = [f"  {'layer':>5}  {'blocks':>6}  {'cells':>9}  of"]
    for layer in filled[:MOST_LISTED]:
        kinds = volume.kinds(layer)
        width, length = volume.extent(layer)
        lines.append(f"  {layer:>5}  {kinds.total():>6}  {f'{width} x {length}':>9}  {kinds_in_words(kinds)}")
    if len(filled) > MOST_LISTED:
        lines.append(f"  and {len(filled) - MOST_LISTED} more")
    head = Text(f"{name}: {len(filled)} of {volume.layers} layers have blocks, 0 is the lowest", style="bold")
    return Group(head, *(Text(line, no_wrap=True, overflow="ellipsis") for line in lines), Text())


def _fields(scenario: Scenario) -> dict[str, Any]:
    fewest = fewest_steps(scenario)
    return {
        "name": scenario.name,
        "size": scenario.size,
        "blocks": scenario.blocks,
        "materials": [dataclasses.asdict(material) for material in scenario.materials],
        "optimum": scenario.optimum,
        "fewest_steps": fewest.steps,
        "is_exact": fewest.exact,
        "builder_steps": len(build(scenario)),
        "step_limit": scenario.step_limit,
        "parts": [
            {"cells": draw_grid(part.cells, scenario.size).split(), "worth": dict(_worth(scenario, part))}
            for part in scenario.parts
        ],
        "choose_every": scenario.choose_every,
        "regions": scenario.regions,
        "design": draw_grid(scenario.design, scenario.size).split(),
    }


def _worth(scenario: Scenario, part: Part) -> list[tuple[str, float]]:
    return [(material.name, p) for material, p in zip(scenario.materials, part.worth, strict=True)]


def _part_line(scenario: Scenario, number: int) -> str:
    part = scenario.parts[number]
    worth = ", ".join(f"{name} {p:+g}" for name, p in _worth(scenario, part))
    every = f"; chosen anew every {scenario.choose_every} steps" if scenario.choose_every else ""
    return f"{f'part {number + 1}':<9}  {len(part.cells)} blocks: {worth}{every}"


def _facts(scenario: Scenario) -> Group:
    fewest = fewest_steps(scenario)
    if fewest.exact:
        steps = f"{fewest.steps} steps; the scripted builder takes {len(build(scenario))}"
    else:
        steps = f"at most {fewest.steps} steps, the scripted builder's: searched up to {EXACT_UP_TO} blocks"
    with_p = "{0.name}" if scenario.parts else "{0.name} {0.p:+g}"
    materials = ", ".join(map(with_p.format, scenario.materials))
    lines = [
        f"arena      {scenario.size} x {scenario.size} cells",
        f"blocks     {scenario.blocks}",
        f"{'regions' if scenario.regions else 'materials':<9}  {materials}",
        *(_part_line(scenario, number) for number in range(len(scenario.parts))),
        f"optimum    {scenario.optimum:g}",
        f"fewest     {steps}",
        f"limit      {scenario.step_limit} steps",
    ]
    drawing = arena_view(scenario, scenario.start, ())
    return Group(Text(scenario.name, style="bold"), drawing, *(Text(f"  {line}") for line in lines))
