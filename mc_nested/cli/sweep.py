"""``mc-nested sweep``: what each choice does that the paper leaves open, or each part of live, on each design."""

from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import paper_scenarios, table_of
from mc_nested.cli.ablation import TRIALS as ABLATION_TRIALS
from mc_nested.cli.ablation import is_ablation, run_ablation
from mc_nested.cli.cluster_options import ClusterOption, InsecureOption, KeysOption, cluster_of
from mc_nested.cli.experiment import (
    MOST_TRIALS,
    JobsOption,
    Outcomes,
    OutOption,
    ResumeOption,
    SeedOption,
    check_nothing_beside_resume,
    jobs_at_once,
    train_all,
)
from mc_nested.cli.experiment_end import Experiment, say_end
from mc_nested.cli.options import LayerOption, ScenariosOption, named_scenarios
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.output_folder import output_folder
from mc_nested.errors import UserError
from mc_nested.learn.agents import check_parts
from mc_nested.learn.experiments.ablation import AblationConfig, shipped_parts
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.learn.experiments.sweep import SweepConfig, shipped_variants
from mc_nested.learn.preset import MOST, load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.sweep_results import Sweep, SweepRow
from mc_nested.workers.cluster.address import SchedulerAddress
from sim.worlds import check_window

VERB = "sweep"
TRIALS, EPISODES, PRESET = 5, 1000, "paper"

FILES = {"table": "sweep.md", "plot": "sweep.png", "rows": "sweep.csv"}


@prints(Experiment)
def sweep(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    ablation: Annotated[
        bool, typer.Option("--ablation", help="turn off each part of the preset live instead; tuned and a planner, too")
    ] = False,
    trials: Annotated[
        int | None,
        typer.Option(
            min=1, max=MOST_TRIALS, help=f"of each variant on each design [{TRIALS}; of an ablation {ABLATION_TRIALS}]"
        ),
    ] = None,
    episodes: Annotated[
        int | None,
        typer.Option(min=1, max=MOST, help=f"episodes a trial [{EPISODES:,}; of an ablation live 30, tuned its own]"),
    ] = None,
    seed: SeedOption = None,
    scenario: ScenariosOption = None,
    layer: LayerOption = None,
    preset: Annotated[str | None, typer.Option(metavar="NAME|FILE", help=f"what is varied [{PRESET}]")] = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    keys: KeysOption = None,
    insecure: InsecureOption = False,
    out: OutOption = None,
    resume: ResumeOption = None,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Vary each choice that the paper leaves open, one at a time; Ctrl+C saves, and --resume goes on from there.

    Writes sweep.png, sweep.md and sweep.csv, or ablation.*. The defaults take about ten minutes on two cores, those of
    an ablation about an hour.
    """
    output = Output(quiet, as_json)
    scheduler = cluster_of(cluster, keys, insecure)
    if resume is not None:
        check_nothing_beside_resume(context.params)
        if is_ablation(resume):
            ablated = ExperimentFolder.open(resume, AblationConfig, VERB)
            with folder_lock(resume):
                run_ablation(ablated, output, scheduler)
            return
        folder = ExperimentFolder.open(resume, SweepConfig, VERB)
        with folder_lock(resume):
            _run(folder, output, scheduler)
        return
    scenarios = named_scenarios(scenario or paper_scenarios(), layer)
    if ablation:
        if preset is not None:
            raise UserError("--ablation takes parts off the presets live and tuned: leave out --preset")
        check_parts(scenarios, load_preset("live"))
        ablation_config = _ablation(scenarios, trials, episodes, seed, jobs or jobs_at_once(scheduler, output))
        with output_folder(out, "ablation") as path:
            run_ablation(ExperimentFolder.new(path, ablation_config, VERB), output, scheduler)
        return
    chosen = load_preset(preset or PRESET)
    check_window(chosen.states, has_window=False)
    base = chosen.model_copy(update={"episodes": episodes or EPISODES})
    config = SweepConfig(
        trials=trials or TRIALS,
        seed=seed or 0,
        jobs=jobs or jobs_at_once(scheduler, output),
        preset_name=preset or PRESET,
        preset=base,
        scenarios=[table_of(each) for each in scenarios],
        variants=shipped_variants(base, scenarios),
    )
    with output_folder(out, "sweep") as path:
        _run(ExperimentFolder.new(path, config, VERB), output, scheduler)


def _ablation(
    scenarios: list[Scenario], trials: int | None, episodes: int | None, seed: int | None, jobs: int
) -> AblationConfig:
    return AblationConfig(
        trials=trials or ABLATION_TRIALS,
        seed=seed or 0,
        jobs=jobs,
        scenarios=[table_of(each) for each in scenarios],
        parts=shipped_parts(episodes),
    )


def _run(folder: ExperimentFolder[SweepConfig], output: Output, scheduler: SchedulerAddress | None) -> None:
    found = sweep_of(folder.config, train_all(folder, output, scheduler))
    # Tests and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.sweep import write_sweep

    with folder.writing():
        write_sweep(folder.path, found)
    say_end(output, Experiment, folder.path, FILES, {})


def sweep_of(config: SweepConfig, outcomes: Outcomes) -> Sweep:
    """The results, variant by variant, scenario by scenario, trial by trial."""
    optimum = {scenario.name: scenario.optimum for scenario in config.loaded_scenarios()}
    variants = {variant.name: variant for variant in config.variants}
    rows: dict[tuple[str, str, int], SweepRow] = {}
    for job, outcome in outcomes:
        for group, scenario, trial, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True):
            variant = variants[group]
            scores = [row.score for row in run.evaluations]
            rows[group, scenario.name, trial] = SweepRow(
                agent=variant.agent,
                choice=variant.choice,
                value=variant.value,
                scenario=scenario.name,
                trial=trial,
                final_score=run.score,
                best_score=max(scores),
                mean_score=sum(scores) / len(scores),
                episodes_to_optimum=next(
                    (row.episode for row in run.evaluations if row.score >= scenario.optimum), None
                ),
            )
    return Sweep(
        preset=Path(config.preset_name).stem,
        episodes=config.preset.episodes,
        trials=config.trials,
        seed=config.seed,
        optimum=optimum,
        rows=[
            rows[name, scenario, trial] for name in variants for scenario in optimum for trial in range(config.trials)
        ],
    )
