"""An experiment's outcomes as the results of the paper's agents on some scenarios, for the claims to be judged."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.env import step_in
from mc_nested.arena.scenario import Scenario
from mc_nested.cli.experiment import Outcomes
from mc_nested.learn.experiments.experiment_folder import OnePresetConfig
from mc_nested.learn.preset import Preset
from mc_nested.report.results import Cost, Evaluation, Results
from sim.grid import arena_env


def results_of_groups(
    config: OnePresetConfig,
    preset: Preset,
    scenarios: Sequence[Scenario],
    agents: Mapping[str, str],
    outcomes: Outcomes,
) -> Results:
    """The results of some groups of runs, trained with ``preset``; ``agents``: which agent each group is."""
    evaluations: dict[tuple[str, str, int], list[Evaluation]] = {}
    costs: dict[tuple[str, str, int], Cost] = {}
    for job, outcome in outcomes:
        for group, scenario, trial, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True):
            if group not in agents:
                continue
            agent = agents[group]
            evaluations[agent, scenario.name, trial] = [
                Evaluation(agent, scenario.name, trial, row.episode, row.score, row.material, row.steps)
                for row in run.evaluations
            ]
            held = () if run.replay_bytes is None else (run.replay_bytes,)
            costs[agent, scenario.name, trial] = Cost(
                agent,
                scenario.name,
                outcome.networks,
                outcome.parameters,
                run.updates,
                run.env_steps,
                outcome.seconds_of(run),
                held,
            )
    names, trials = [scenario.name for scenario in scenarios], range(config.trials)
    return Results(
        agents=list(agents.values()),
        scenarios=names,
        trials=config.trials,
        episodes=preset.episodes,
        evaluate_every=preset.evaluate_every,
        seed=config.seed,
        preset=Path(config.preset_name).stem,
        keeps_best=preset.keep == "best",
        optimum={scenario.name: scenario.optimum for scenario in scenarios},
        builder={scenario.name: builders_score(scenario) for scenario in scenarios},
        # In an order that doesn't depend on how the runs were divided into jobs.
        evaluations=[
            row
            for agent in agents.values()
            for name in names
            for trial in trials
            for row in evaluations[agent, name, trial]
        ],
        costs=[_sum([costs[agent, name, trial] for trial in trials]) for agent in agents.values() for name in names],
    )


def _sum(costs: Sequence[Cost]) -> Cost:
    held = tuple(count for cost in costs for count in cost.replay_bytes)
    return costs[0]._replace(
        replay_bytes=held if len(held) == len(costs) else (),
        updates=sum(cost.updates for cost in costs),
        env_steps=sum(cost.env_steps for cost in costs),
        seconds=sum(cost.seconds for cost in costs),
    )


def builders_score(scenario: Scenario) -> float:
    """The scripted builder's score within the step limit, with the best material of each part."""
    env = arena_env(scenario)
    env.reset(options={"material": scenario.materials[scenario.best_material].name})
    for step in build_with_materials(scenario):
        _, _, terminated, truncated, info = env.step(step_in(scenario, *step))
        if terminated or truncated:
            return float(info["score"])
    raise AssertionError("the builder places every block, which ends the episode")
