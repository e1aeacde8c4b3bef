"""``mc-nested reproduce``: the paper's experiment, every agent on every design, and tests of its claims."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table
from rich.text import Text

from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import paper_scenarios, table_of
from mc_nested.cli.experiment import (
    MOST_TRIALS,
    JobsOption,
    Outcomes,
    OutOption,
    ResumeOption,
    SeedOption,
    check_nothing_beside_resume,
    cores,
    train_all,
)
from mc_nested.cli.experiment_end import say_end
from mc_nested.cli.output import JsonOption, Output, QuietOption
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.scenario_options import LayerOption, ScenariosOption, named_scenarios
from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS, check_exploration
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.learn.experiments.reproduction import LONGER, LONGER_AGENTS, LONGER_SCENARIOS, ReproduceConfig
from mc_nested.learn.preset import MOST, load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.results import Cost, Evaluation, Results
from sim.grid import arena_env

if TYPE_CHECKING:  # it loads scipy, which a process that only waits for others doesn't need
    from mc_nested.report.verdicts import JudgedClaim

VERB = "reproduce"
TRIALS, PRESET = 10, "paper"

FILES = {"report": "report.md", "figure": "figure5.png", "table": "results.csv"}


def reproduce(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    trials: Annotated[
        int | None, typer.Option(min=1, max=MOST_TRIALS, help=f"of each agent on each design [{TRIALS}]")
    ] = None,
    episodes: Annotated[int | None, typer.Option(min=1, max=MOST, help="episodes a trial [the preset's]")] = None,
    seed: SeedOption = None,
    scenario: ScenariosOption = None,
    layer: LayerOption = None,
    agent: Annotated[
        list[str] | None, typer.Option(help=f"an agent, as often as you like [{', '.join(AGENT_SPECS)}]")
    ] = None,
    preset: Annotated[str | None, typer.Option(metavar="NAME|FILE", help=f"hyper-parameters [{PRESET}]")] = None,
    longer: Annotated[
        int | None,
        typer.Option(
            min=2,
            max=1000,
            help="also train nested and hierarchical on zigzag and diamond so many times as long [no]",
        ),
    ] = None,
    jobs: JobsOption = None,
    out: OutOption = None,
    resume: ResumeOption = None,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Repeat the paper's experiment and test its claims; Ctrl+C saves, and --resume goes on from there.

    Writes figure5.png and figure5.svg, results.csv and report.md. The defaults take some minutes on two cores.
    """
    output = Output(quiet, as_json)
    if resume is not None:
        check_nothing_beside_resume(context.params)
        folder = ExperimentFolder.open(resume, ReproduceConfig, VERB)
        with folder_lock(resume):
            _run(folder, output)
        return
    for name in agent or ():
        if name not in AGENT_SPECS:
            raise UserError(f"no agent {name!r}: choose one of {', '.join(AGENT_SPECS)}")
    chosen = load_preset(preset or PRESET)
    for name in agent or AGENT_SPECS:
        check_exploration(AGENT_SPECS[name], chosen)
    config = ReproduceConfig(
        agents=[name for name in AGENT_SPECS if name in agent] if agent else list(AGENT_SPECS),
        trials=trials or TRIALS,
        seed=seed or 0,
        jobs=jobs or cores(),
        longer=longer or 0,
        preset_name=preset or PRESET,
        preset=chosen.model_copy(update={"episodes": episodes or chosen.episodes}),
        scenarios=[table_of(each) for each in named_scenarios(scenario or paper_scenarios(), layer)],
    )
    if longer and not (config.longer_agents and config.longer_scenarios):
        raise UserError(
            f"--longer is for {' and '.join(LONGER_AGENTS)} on {' and '.join(LONGER_SCENARIOS)}: "
            f"leave it out, or name one of each"
        )
    with output_folder(out, "figure5") as path:
        _run(ExperimentFolder.new(path, config, VERB), output)


def _run(folder: ExperimentFolder[ReproduceConfig], output: Output) -> None:
    outcomes = train_all(folder, output)
    results, longer = results_of(folder.config, outcomes)
    # Tests and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.reproduction import write_reproduction

    with folder.writing():
        claims = write_reproduction(folder.path, results, longer)
    found = {
        "claims": [
            {"letter": each.claim.letter, "claim": each.claim.title, "verdict": each.verdict.value} for each in claims
        ]
    }
    say_end(output, folder.path, FILES, found, _verdicts(claims))


def results_of(config: ReproduceConfig, outcomes: Outcomes) -> tuple[Results, Results | None]:
    """The experiment's results, and those of its longer runs if there are any."""
    usual = _results(config, config.agents, [table.name for table in config.scenarios], outcomes, "")
    if not config.longer:
        return usual, None
    return usual, _results(config, config.longer_agents, config.longer_scenarios, outcomes, LONGER)


def _results(
    config: ReproduceConfig, agents: Sequence[str], names: Sequence[str], outcomes: Outcomes, suffix: str
) -> Results:
    evaluations: dict[tuple[str, str, int], list[Evaluation]] = {}
    costs: dict[tuple[str, str], dict[int, Cost]] = {(agent, name): {} for agent in agents for name in names}
    for job, outcome in outcomes:
        updates = sum(run.updates for run in outcome.runs)
        for group, scenario, trial, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True):
            agent = group.removesuffix(LONGER)
            if group != agent + suffix:
                continue
            evaluations[agent, scenario.name, trial] = [
                Evaluation(agent, scenario.name, trial, row.episode, row.score, row.material, row.steps)
                for row in run.evaluations
            ]
            seconds = outcome.seconds * run.updates / updates if updates else 0.0
            held = () if run.replay_bytes is None else (run.replay_bytes,)
            costs[agent, scenario.name][trial] = Cost(
                agent, scenario.name, outcome.networks, outcome.parameters, run.updates, run.env_steps, seconds, held
            )
    scenarios = [scenario for scenario in config.loaded_scenarios() if scenario.name in names]
    preset = config.longer_preset if suffix else config.preset
    return Results(
        agents=agents,
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
            for agent in agents
            for name in names
            for trial in range(config.trials)
            for row in evaluations[agent, name, trial]
        ],
        costs=[_sum([own[trial] for trial in range(config.trials)]) for own in costs.values()],
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
    """The scripted builder's score within the step limit, with the best material."""
    env = arena_env(scenario)
    env.reset(options={"material": scenario.materials[scenario.best_material].name})
    for action in build(scenario):
        _, _, terminated, truncated, info = env.step(action)
        if terminated or truncated:
            return float(info["score"])
    raise AssertionError("the builder places every block, which ends the episode")


def _verdicts(claims: "Sequence[JudgedClaim]") -> Table:
    table = Table("", "the paper's claim", "verdict", box=None, padding=(0, 1))
    for judged in claims:
        table.add_row(f"({judged.claim.letter})", Text(judged.claim.title), judged.verdict.value)
    return table
