"""The tally of arenas with parts: which part is being built, what was laid of which material, and what that earns."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.scenario import Scenario, main_return, regions_of
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s

NEVER = np.iinfo(np.int64).max
"""Steps after which the main agent chooses again, where it chooses as a part begins and not in between."""

OFF_DESIGN = -1

THE_ARENA = np.ones(1, dtype=np.bool_)
"""The mask of the one arena of a tally of one."""


class Tally:
    """R episodes, each of its own scenario: every array is (R,) or (R, ...).

    The part that is built follows from the blocks laid. A block counts for that part and for the material in hand. In
    an episode's score, the blocks that its last part lacks count for the material in hand at the end.
    """

    def __init__(self, scenarios: Sequence[Scenario]) -> None:
        runs = len(scenarios)
        parts = max(len(scenario.in_order) for scenario in scenarios)
        # Materials that are worth the same count as one, so that their shares add up to p exactly.
        worths = [[list(dict.fromkeys(part.worth)) for part in scenario.in_order] for scenario in scenarios]
        materials = max(len(scenario.materials) for scenario in scenarios)
        differ = max(len(worth) for of_scenario in worths for worth in of_scenario)
        side, blocks = max(scenario.size for scenario in scenarios), max(scenario.blocks for scenario in scenarios)
        self._each = np.arange(runs)
        self._sizes = np.ones((runs, parts), dtype=np.int64)
        self._worth = np.zeros((runs, parts, differ))
        self._counts_for = np.zeros((runs, parts, materials), dtype=np.int64)
        self._part_of = np.full((runs, side, side), OFF_DESIGN)
        self._region_of = np.zeros((runs, side, side), dtype=np.int64)
        self._part_after = np.zeros((runs, blocks + 1), dtype=np.int64)
        self._laid_after = np.zeros((runs, parts), dtype=np.int64)
        for run, scenario in enumerate(scenarios):
            used = range(len(scenario.in_order))
            for number, part in enumerate(scenario.in_order):
                self._sizes[run, number] = len(part.cells)
                own = worths[run][number]
                self._worth[run, number, : len(own)] = own
                self._counts_for[run, number, : len(part.worth)] = [own.index(p) for p in part.worth]
                for x, y in part.cells:
                    self._part_of[run, x, y] = number
            if scenario.regions:
                self._region_of[run, : scenario.size, : scenario.size] = regions_of(
                    scenario.size, len(scenario.materials)
                )
            self._laid_after[run, : len(used)] = np.cumsum(self._sizes[run, : len(used)])
            self._part_after[run, : scenario.blocks + 1] = [
                scenario.part_at(scenario.blocks - laid) for laid in range(scenario.blocks + 1)
            ]
        self._choose_every = np.array([scenario.choose_every or NEVER for scenario in scenarios])
        self._by_region = np.array([scenario.regions for scenario in scenarios])
        self._materials = np.array([len(scenario.materials) for scenario in scenarios])
        self._laid = np.zeros(runs, dtype=np.int64)
        self._of = np.zeros((runs, parts, differ), dtype=np.int64)
        self._on_part = np.zeros(runs, dtype=np.int64)
        self._in_hand = np.zeros(runs, dtype=np.int64)
        self._since_choice = np.zeros(runs, dtype=np.int64)

    @property
    def in_hand(self) -> Int64s:
        """The material in hand, (R,)."""
        return self._in_hand

    def begin(self, begins: Bools, materials: Int64s) -> None:
        """Begin an episode in the masked arenas, with these materials in hand (R,)."""
        for counted in (self._laid, self._of, self._on_part, self._since_choice):
            counted[begins] = 0
        self._in_hand[begins] = materials[begins]

    def take(self, takes: Bools, materials: Int64s) -> None:
        """Take these materials (R,) in hand in the masked arenas; ValueError if a scenario doesn't have one."""
        if (takes & ((materials < 0) | (materials >= self._materials))).any():
            raise ValueError("material: an index that the scenario doesn't have")
        self._in_hand = np.where(takes, materials, self._in_hand)

    def lay(self, landed: Bools, x: Int64s, y: Int64s) -> Bools:
        """Count the blocks that landed now, in the masked arenas, and return which of them pay, r_N (R,).

        Those that are on the part which is built; with regions, in the one in hand. Elsewhere (x, y) means nothing.
        """
        part, y = self._part_after[self._each, self._laid], np.minimum(y, self._part_of.shape[2] - 1)
        on_part = landed & (self._part_of[self._each, x, y] == part)
        self._of[self._each, part, self._counts_for[self._each, part, self._in_hand]] += landed
        self._on_part += on_part
        self._laid += landed
        pays: Bools = on_part & (~self._by_region | (self._region_of[self._each, x, y] == self._in_hand))
        return pays

    def chooses(self, stepped: Bools, landed: Bools) -> Bools:
        """Return whether the main agent has to choose now, after a step in the masked arenas, (R,).

        It has to when the blocks of a part are used up, and when its clock has run so many steps since its last choice;
        with regions, after each block.
        """
        self._since_choice += stepped
        part, before = (self._part_after[self._each, laid] for laid in (self._laid, self._laid - landed))
        over = (part != before) | (self._by_region & landed)
        due: Bools = stepped & (over | (self._since_choice >= self._choose_every))
        self._since_choice[due] = 0
        return due

    def total(self, ended: Bools) -> Float64s:
        """Return r_M so far, (R,); in the episodes that have ended, the blocks that their part lacks count, too.

        But a part after the first of which no block was laid earns nothing.
        """
        part = self._part_after[self._each, self._laid]
        lacks = self._laid_after[self._each, part] - self._laid
        is_begun = (part == 0) | (lacks < self._sizes[self._each, part])
        lacks = np.where(ended & is_begun, lacks, 0)
        of = self._of.copy()
        of[self._each, part, self._counts_for[self._each, part, self._in_hand]] += lacks
        return main_return(self._on_part, of, self._worth, self._sizes)

    def info(self, stepped: Bools, landed: Bools, ended: Bools) -> dict[str, Any]:
        """Return a step's ``info`` in a vector env: ``score``, ``earned``, ``chooses``, with Gymnasium's masks."""
        chooses = self.chooses(stepped, landed) & ~ended
        total = self.total(ended)
        masks = {"_score": ended, "_earned": stepped, "_chooses": stepped}
        score, earned = np.where(ended, total, 0.0), np.where(stepped, total, 0.0)
        return {"score": score, "earned": earned, "chooses": chooses, **masks}

    def snapshot(self) -> Arrays:
        """Return the episodes as they stand, for ``restore``."""
        return {f"tally{name}": getattr(self, name).copy() for name in self._STATE}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the episodes back as they stood at ``snapshot``."""
        for name in self._STATE:
            setattr(self, name, snapshot[f"tally{name}"].copy())

    _STATE = ("_laid", "_of", "_on_part", "_in_hand", "_since_choice")


def tally_of(scenarios: Sequence[Scenario]) -> Tally | None:
    """Return the tally of these scenarios' arenas; None if none of them has parts."""
    return Tally(scenarios) if any(scenario.parts for scenario in scenarios) else None
