"""Builders: who build together in the arena of each run, and how they learn (paper, section 6).

shared  a main agent sees (x, y, b) of builder 0 and chooses the material; one nested agent plays every builder. It sees
        (x, y, b, number, a_M), and learns from all builders' transitions: an update for each of them
own     the same states, but each builder has a nested agent of its own, which learns from its own transitions alone
single  each builder has a ten-action agent of its own, which sees (x, y, b, m) (arena/single.py)

A builder alone has no number: it is the paper's nested agent, or its single agent, to the bit.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import PresetError
from mc_nested.learn.dqn.engines import NUMBERS
from mc_nested.learn.preset import Preset

Networks = Literal["shared", "own", "single"]
"""How the builders of a team learn."""

NETWORKS: tuple[Networks, ...] = get_args(Networks)


@dataclass(frozen=True)
class Builders:
    """The builders of every run's arena: their start cells, in the order of their numbers, and how they learn."""

    starts: tuple[Cell, ...]
    networks: Networks = "shared"

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.starts)

    @property
    def agent(self) -> str:
        """Which of the paper's agents they are."""
        return "single" if self.networks == "single" else "nested"

    def scenarios_of(self, scenarios: Sequence[Scenario]) -> list[Scenario]:
        """Return each run's scenario as each of its builders begins it: a row for each run and builder."""
        return [replace(scenario, start=start) for scenario in scenarios for start in self.starts]


def check_builders(preset: Preset) -> None:
    """Raise PresetError if the preset explores in a way, or sees what, builders in one arena can't."""
    if preset.states != NUMBERS:
        raise PresetError(f"several builders see numbers, not states {preset.states!r}: take the preset paper")
    for name, table in (("[excursions]", preset.excursions), ("[imagination]", preset.imagination)):
        if table:  # both replay a path, or imagine a game, in which nobody else acts
            raise PresetError(f"a preset with {name} is for one agent alone: take paper, or one with [explore_nested]")
