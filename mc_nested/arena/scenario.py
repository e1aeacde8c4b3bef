"""Scenario: the design to build, the start cell, the step limit, and the value of each material."""

from dataclasses import dataclass

from mc_nested.arena.action import Cell
from mc_nested.errors import ScenarioError


@dataclass(frozen=True)
class Material:
    """A material of the main agent's choice: its name, the p of choosing it (paper, section 5.1.3) and its block id.

    The id is the one of Minecraft 1.13 and later, without its namespace; a profile translates it for other games.
    """

    name: str
    p: float
    block: str


@dataclass(frozen=True)
class Scenario:
    """A task: build the design's cells, one block each, from the start cell within the step limit."""

    name: str
    design: frozenset[Cell]
    start: Cell
    step_limit: int
    materials: tuple[Material, ...]

    @property
    def blocks(self) -> int:
        """Blocks available: as many as the design needs (paper, section 5.1.1)."""
        return len(self.design)

    @property
    def start_state(self) -> tuple[int, int, int]:
        """(x, y, b) before the first move: what the main agent decides on."""
        return *self.start, self.blocks

    @property
    def best_material(self) -> int:
        """Index of the material with the highest p; the first if several have the same."""
        return max(range(len(self.materials)), key=lambda index: self.materials[index].p)

    @property
    def optimum(self) -> float:
        """The highest score: every block on the design, of the best material."""
        return self.blocks + self.materials[self.best_material].p

    def material_index(self, name: str) -> int:
        """Index of the material of that name; ScenarioError if there is none."""
        names = [material.name for material in self.materials]
        if name not in names:
            raise ScenarioError(f"scenario {self.name} has no material {name!r}: choose one of {', '.join(names)}")
        return names.index(name)
