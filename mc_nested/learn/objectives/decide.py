"""What the agent with objectives does next: a pure function of what it sees and of its plan.

The main agent chooses an objective: the cell to build next, and of which material. The nested agent acts until a block
has landed, or for PATIENCE steps a side; then the main agent chooses again (paper, Algorithm 1). Both are greedy.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import end_of_episode, landing, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import THE_ARENA, Tally
from mc_nested.arrays import Bools, Float32s
from mc_nested.learn.dqn.states import LOSES, Sees
from mc_nested.learn.objectives.arenas import (
    framed,
    framed_cells,
    order_planes,
    outside,
    plane_of_each,
    reach_planes,
    side_for,
)
from mc_nested.learn.objectives.networks import OrderNetwork, Reaching, ReachNetwork

PATIENCE = 4
"""Steps for each cell of the frame's side after which an objective is given up."""


class Decision(NamedTuple):
    """What is done next: an action, with that material in hand."""

    action: Action
    material: int


@dataclass(frozen=True)
class Plan:
    """What the agent is about.

    ``objective`` is None before the first; ``steps`` were spent on it; ``blocks`` had landed when it was chosen.
    ``given_up`` are objectives that weren't reached since the last block landed. ``tried`` is what was done on the way
    to this one, and where: the same again in the same cell would lead round in a circle.
    """

    objective: Cell | None = None
    steps: int = 0
    blocks: int = 0
    given_up: frozenset[Cell] = frozenset()
    tried: frozenset[tuple[Cell, Action]] = frozenset()


class ObjectiveAgent:
    """The agent with objectives in one scenario, whose design it is told.

    ``order`` says what each cell is worth as the next one, as ``OrderNetwork.values``: the main agent's network, where
    nothing is put in its place.

    Args:
        main: the main agent's parameters, (parameters,).
        nested: the nested agent's.
        scenario: what is built.
        sees: what the nested agent is shown.

    Raises:
        ValueError: they aren't the parameters of such networks.
    """

    def __init__(self, main: Float32s, nested: Float32s, scenario: Scenario, sees: Sees = "everything") -> None:
        self.order: Callable[[Bools], Float32s] = OrderNetwork(main).values
        self._nested = ReachNetwork(nested)
        self._scenario, self._sees = scenario, sees
        self._side = side_for(scenario.size)
        self._outside = outside(scenario.size, self._side)
        # An action that was announced is chosen again when its time comes.
        self._chosen = lru_cache(maxsize=4)(self._choose)
        self._reaching = lru_cache(maxsize=4)(self._reach)

    def decide(self, plan: Plan, cell: Cell, placed: frozenset[Cell]) -> tuple[Decision, Plan]:
        """Return what to do in that cell, with blocks in these, and the plan from then on.

        ValueError if nothing is left to build.
        """
        plan = self._kept(plan, cell, placed)
        if plan.objective is None:
            raise ValueError("nothing is left to build")
        reaching = self._reaching(plan.objective, placed)
        values = self._nested.values(reaching, np.array([framed(cell)]))[0]
        untried = [each for each in Action if (cell, each) not in plan.tried] or list(Action)
        action = max(untried, key=lambda each: float(values[each]))
        part = self._scenario.part_at(self._scenario.blocks - len(placed))
        then = replace(plan, steps=plan.steps + 1, tried=plan.tried | {(cell, action)})
        return Decision(action, self._scenario.best_materials[part]), then

    def is_stuck(self, plan: Plan, placed: frozenset[Cell]) -> bool:
        """Return whether no cell is left, or each was given up since the last block landed."""
        left = self._left(placed)
        return not left or (plan.blocks == len(placed) and left <= plan.given_up)

    def expected(self, cell: Cell, placed: frozenset[Cell], action: Action) -> tuple[Cell, frozenset[Cell]]:
        """Return where the agent is after an action, and where blocks are then, as the rules say."""
        cell = moved(cell, action, placed, self._scenario.size)
        block = landing(cell, action, placed, self._scenario.size)
        return cell, placed if block is None else placed | {block}

    def _kept(self, plan: Plan, cell: Cell, placed: frozenset[Cell]) -> Plan:
        """Return the plan, with another objective where one is to be chosen."""
        given_up = plan.given_up
        if plan.blocks != len(placed):
            given_up = frozenset()
        elif plan.objective is not None:
            if plan.steps < PATIENCE * self._side:
                return plan
            given_up |= {plan.objective}
        left = self._left(placed)
        open_cells = left - given_up or left
        if not open_cells:
            return Plan(blocks=len(placed))
        return Plan(self._chosen(open_cells, cell, placed), 0, len(placed), given_up)

    def _left(self, placed: Collection[Cell]) -> frozenset[Cell]:
        """Return the cells still to build of the part that is built now."""
        scenario = self._scenario
        return scenario.in_order[scenario.part_at(scenario.blocks - len(placed))].cells - frozenset(placed)

    def _choose(self, open_cells: frozenset[Cell], cell: Cell, placed: frozenset[Cell]) -> Cell:
        """Return the cell that the main agent wants next."""
        later = self._scenario.design - placed - self._left(placed)
        wanted = framed_cells(open_cells | later, self._side)[None]
        planes, _ = order_planes(wanted, self._occupied(placed)[None], np.array([framed(cell)]))
        values, loses = self.order(planes)[0], planes[0, LOSES]
        return max(sorted(open_cells), key=lambda each: (not loses[framed(each)], float(values[framed(each)])))

    def _reach(self, objective: Cell, placed: frozenset[Cell]) -> Reaching:
        """Return what the nested agent knows of that objective."""
        wanted = plane_of_each(np.array([framed(objective)]), self._side)
        nowhere = np.zeros((1, 2), np.int64)
        return self._nested.reaching(reach_planes(wanted, self._occupied(placed)[None], nowhere, self._sees))

    def _occupied(self, placed: Collection[Cell]) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        return self._outside | framed_cells(placed, self._side)


class EpisodeByRules(NamedTuple):
    """An episode: where blocks stand at its end, its steps, and its score r_M."""

    placed: frozenset[Cell]
    steps: int
    score: float


def built_by_the_rules(agent: ObjectiveAgent, scenario: Scenario) -> EpisodeByRules:
    """Return one episode of that agent, if all goes as the rules say."""
    plan, cell, placed, steps, tally = Plan(), scenario.start, frozenset[Cell](), 0, Tally([scenario])
    tally.begin(THE_ARENA, np.array([scenario.best_material]))
    while not (
        agent.is_stuck(plan, placed) or any(end_of_episode(scenario.blocks - len(placed), steps, scenario.step_limit))
    ):
        decision, plan = agent.decide(plan, cell, placed)
        before = placed
        cell, placed = agent.expected(cell, placed, decision.action)
        tally.take(THE_ARENA, np.array([decision.material]))
        for x, y in placed - before:
            tally.lay(THE_ARENA, np.array([x]), np.array([y]))
        steps += 1
    return EpisodeByRules(placed, steps, float(tally.total(THE_ARENA)[0]))
