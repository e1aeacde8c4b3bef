"""``mc-nested sweep --ablation``: the preset live with each part off in turn, on each design."""

from pathlib import Path

from mc_nested.cli.experiment import Outcomes, train_all
from mc_nested.cli.experiment_end import Experiment, say_end
from mc_nested.cli.output import Output
from mc_nested.errors import RunError
from mc_nested.learn.experiments.ablation import AblationConfig
from mc_nested.learn.experiments.experiment_folder import CONFIG, ExperimentFolder
from mc_nested.report.ablation_results import Ablation, AblationPart, AblationRow
from mc_nested.report.benchmark_results import played_to_optimum
from mc_nested.toml_file import parse_document, read_toml_text
from mc_nested.workers.cluster.address import SchedulerAddress

TRIALS = 10

FILES = {"table": "ablation.md", "plot": "ablation.png", "rows": "ablation.csv"}

OWN_KEY = "parts"
"""The key of config.toml that only an ablation has, not a sweep."""


def is_ablation(folder: Path) -> bool:
    """Whether that folder's config is an ablation's; RunError if it can't be read."""
    file = folder / CONFIG
    return file.is_file() and OWN_KEY in parse_document(read_toml_text(file, RunError), str(file), RunError)


def run_ablation(folder: ExperimentFolder[AblationConfig], output: Output, scheduler: SchedulerAddress | None) -> None:
    """Train what is missing, and write the report; errors as train_all's."""
    found = ablation_of(folder.config, train_all(folder, output, scheduler))
    # Statistics and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.ablation import write_ablation

    with folder.writing():
        write_ablation(folder.path, found)
    say_end(output, Experiment, folder.path, FILES, {})


def ablation_of(config: AblationConfig, outcomes: Outcomes) -> Ablation:
    """The results, part by part, scenario by scenario, trial by trial."""
    parts = {part.name: part for part in config.parts}
    optimum = {scenario.name: scenario.optimum for scenario in config.loaded_scenarios()}
    rows: dict[tuple[str, str, int], AblationRow] = {}
    for job, outcome in outcomes:
        for group, scenario, trial, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True):
            scores = [(row.episode, row.score) for row in run.evaluations]
            rows[group, scenario.name, trial] = AblationRow(
                part=group,
                base=parts[group].base,
                scenario=scenario.name,
                trial=trial,
                optimum=scenario.optimum,
                best_score=max(score for _, score in scores),
                played_to_optimum=played_to_optimum(scores, scenario.optimum),
                updates=run.updates,
            )
    return Ablation(
        trials=config.trials,
        seed=config.seed,
        optimum=optimum,
        parts=[AblationPart(part.name, part.base, part.what, part.preset.episodes) for part in config.parts],
        # In an order that doesn't depend on how the runs were divided into jobs.
        rows=[rows[name, scenario, trial] for name in parts for scenario in optimum for trial in range(config.trials)],
    )
