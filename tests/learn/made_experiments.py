"""Experiments that take a moment: small designs, small networks, few episodes."""

from typing import Any

import tomlkit

from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import draw_grid, table_of
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.studies.arm import Arm, Run
from mc_nested.studies.job import Job, cut_into_jobs

MATERIALS = Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")

DOT = Scenario("dot", frozenset({(7, 13)}), (7, 13), 4, MATERIALS)
BAR = Scenario("bar", frozenset({(6, 12), (7, 12), (8, 12)}), (7, 13), 9, MATERIALS)


def small_preset(episodes: int = 20) -> Preset:
    paper = load_preset("paper")
    update = paper.update.model_copy(update={"batch": 4, "learning_starts": 4, "target_period": 10})
    changes = {"episodes": episodes, "evaluate_every": 5, "hidden": [4, 4], "replay_capacity": 1000, "update": update}
    return paper.model_copy(update=changes)


def small_preset_text() -> str:
    return tomlkit.dumps(small_preset().model_dump(exclude_none=True))


def run_config(design: Scenario = DOT, **changes: Any) -> RunConfig:
    """Return a training of the nested agent on that design, in the simulator."""
    made = {
        "agent": "nested",
        "backend": "sim",
        "trials": 1,
        "seed": 0,
        "stop_at_optimum": False,
        "preset_name": "small",
        "preset": small_preset(),
        "scenario": table_of(design),
    }
    return RunConfig(**{**made, **changes})


def scenario_text(scenario: Scenario) -> str:
    materials = "\n".join(
        f'[[materials]]\nname = "{m.name}"\np = {m.p}\nblock = "{m.block}"' for m in scenario.materials
    )
    return (
        f'name = "{scenario.name}"\nstart = {list(scenario.start)}\nstep_limit = {scenario.step_limit}\n'
        f'design = """\n{draw_grid(scenario.design, scenario.size)}"""\n{materials}\n'
    )


def runs_of(agents: list[str], scenarios: list[Scenario], trials: int, preset: Preset) -> list[Run]:
    return [
        Run(Arm(agent, preset, (), trials, agent), scenario, trial)
        for agent in agents
        for scenario in scenarios
        for trial in range(trials)
    ]


def one_job(agent: str, scenarios: list[Scenario], trials: int, episodes: int = 20) -> Job:
    return cut_into_jobs(runs_of([agent], scenarios, trials, small_preset(episodes)), 1, seed=3)[0]
