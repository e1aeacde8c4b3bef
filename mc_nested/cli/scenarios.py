"""``mc-nested scenarios``: the designs as drawings, with their optimum and the fewest steps."""

from typing import Annotated

import typer
from rich.console import Console, Group
from rich.text import Text

from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.arena.search import EXACT_UP_TO, fewest_steps
from mc_nested.report.terminal import arena_view


def scenarios(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME|FILE]...", help="which (default: all that are shipped)")
    ] = None,
) -> None:
    """List the designs with a drawing, the optimum and the fewest steps of a full build."""
    console = Console()
    for name in names or shipped_scenarios():
        console.print(_facts(load_scenario(name)))
        console.print()


def _facts(scenario: Scenario) -> Group:
    fewest = fewest_steps(scenario)
    if fewest.exact:
        steps = f"{fewest.steps} steps; the scripted builder takes {len(build(scenario))}"
    else:
        steps = f"at most {fewest.steps} steps, the scripted builder's: searched up to {EXACT_UP_TO} blocks"
    materials = ", ".join(f"{material.name} {material.p:+g}" for material in scenario.materials)
    lines = [
        f"arena      {scenario.size} x {scenario.size} cells",
        f"blocks     {scenario.blocks}",
        f"materials  {materials}",
        f"optimum    {scenario.optimum:g}",
        f"fewest     {steps}",
        f"limit      {scenario.step_limit} steps",
    ]
    drawing = arena_view(scenario, scenario.start, ())
    return Group(Text(scenario.name, style="bold"), drawing, *(Text(f"  {line}") for line in lines))
