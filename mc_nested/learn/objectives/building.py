"""The steps with which the agent with objectives builds in an Env, each with what comes next."""

from collections.abc import Iterator
from typing import NamedTuple

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import ArenaEnv, step_in
from mc_nested.learn.objectives.decide import Decision, ObjectiveAgent, Plan


class Step(NamedTuple):
    """An action with its material in hand, what comes next if all goes as the rules say, and the cell it is for."""

    taken: tuple[Action, int]
    following: tuple[Action, int] | None
    objective: Cell | None = None


def steps_of(agent: ObjectiveAgent, env: ArenaEnv, material: int | None = None) -> Iterator[Step]:
    """Yield the agent's greedy steps in a running episode, each chosen once the one before is done.

    They end where the agent is stuck; whoever takes them ends where the episode does. ``material``: build all of it, in
    place of what is worth most.
    """

    def of_material(decision: Decision) -> Decision:
        return decision if material is None else decision._replace(material=material)

    plan = Plan()
    while not agent.is_stuck(plan, env.placed):
        decision, plan = agent.decide(plan, env.cell, env.placed)
        taken = of_material(decision)
        cell, placed = agent.expected(env.cell, env.placed, taken.action)
        _, goes_on, _ = env.expected(step_in(env.scenario, *taken))
        is_last = not goes_on or agent.is_stuck(plan, placed)
        yield Step(taken, None if is_last else of_material(agent.decide(plan, cell, placed)[0]), plan.objective)
