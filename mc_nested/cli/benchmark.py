"""``mc-nested benchmark``: how few episodes agents and presets need on designs that nobody tuned them on."""

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Column, Table
from rich.text import Text

from mc_nested.arena.corpus_file import MOST_DESIGNS, load_corpus
from mc_nested.arena.design import kind_of_design
from mc_nested.arena.random_designs import random_scenario
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, table_of
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
from mc_nested.cli.experiment_end import say_end
from mc_nested.cli.output import JsonOption, Output, QuietOption
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.screen_states import check_window
from mc_nested.errors import UserError
from mc_nested.learn.experiments.benchmark import (
    AGENTS,
    SB3,
    BenchmarkConfig,
    contestants_of,
    episodes_without_a_prior,
    trial_of,
)
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.learn.experiments.sb3_model import HOW_TO_INSTALL, LIBRARY, is_installed
from mc_nested.learn.preset import load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.benchmark_results import Benchmark, BenchmarkRow, played_to_optimum
from mc_nested.workers.cluster.address import SchedulerAddress

if TYPE_CHECKING:  # it loads scipy, which a process that only waits for others doesn't need
    from mc_nested.report.benchmark_measures import Measures

VERB = "benchmark"
TRIALS, DESIGNS = 1, 100
DEFAULT_AGENTS, DEFAULT_PRESETS = ("nested", SB3), ("live", "tuned", "paper")

FILES = {"report": "benchmark.md", "plot": "benchmark.png", "rows": "benchmark.csv"}

LIKE = "line"
"""The shipped design whose start cell and materials every design of a benchmark has."""


def benchmark(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    designs: Annotated[
        int | None, typer.Option(min=1, max=MOST_DESIGNS, help=f"random designs, drawn from the seed [{DESIGNS}]")
    ] = None,
    corpus: Annotated[
        Path | None, typer.Option(metavar="FILE", help="a TOML file of drawings instead of random designs")
    ] = None,
    agents: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME,...", help=f"of {', '.join(AGENTS)} [{','.join(DEFAULT_AGENTS)}]"),
    ] = None,
    presets: Annotated[
        list[str] | None, typer.Option(metavar="NAME|FILE,...", help=f"of each agent [{','.join(DEFAULT_PRESETS)}]")
    ] = None,
    trials: Annotated[int | None, typer.Option(min=1, max=MOST_TRIALS, help=f"on each design [{TRIALS}]")] = None,
    seed: SeedOption = None,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    keys: KeysOption = None,
    insecure: InsecureOption = False,
    out: OutOption = None,
    resume: ResumeOption = None,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Count the episodes to the optimum on many designs; Ctrl+C saves, and --resume goes on from there.

    Writes benchmark.png, benchmark.md and benchmark.csv. sb3 is stable-baselines3's DQN, for comparison.
    """
    output = Output(quiet, as_json)
    scheduler = cluster_of(cluster, keys, insecure)
    if resume is not None:
        check_nothing_beside_resume(context.params)
        folder = ExperimentFolder.open(resume, BenchmarkConfig, VERB)
        with folder_lock(resume):
            _run(folder, output, scheduler)
        return
    if corpus is not None and designs is not None:
        raise UserError("--designs is how many are drawn at random: leave it out, or leave out --corpus")
    chosen = [(name, load_preset(name)) for name in _listed(presets) or DEFAULT_PRESETS]
    for _, preset in chosen:
        check_window(preset.states, has_window=False)
    contestants, left_out = contestants_of(_agents(_listed(agents), bool(presets)), chosen)
    for line in left_out:
        typer.echo(line, err=True)
    scenarios = _scenarios(corpus, designs or DESIGNS, seed or 0)
    config = BenchmarkConfig(
        trials=trials or TRIALS,
        seed=seed or 0,
        jobs=jobs or jobs_at_once(scheduler, output),
        corpus=corpus.name if corpus else None,
        designs=[table_of(scenario) for scenario in scenarios],
        contestants=contestants,
    )
    with output_folder(out, VERB) as path:
        _run(ExperimentFolder.new(path, config, VERB), output, scheduler)


def _listed(options: Sequence[str] | None) -> list[str]:
    """The names of an option that can be repeated, each with commas between names; each name once."""
    return list(dict.fromkeys(name.strip() for option in options or () for name in option.split(",")))


def _agents(asked: Sequence[str], names_presets: bool) -> list[str]:
    """The agents; UserError if one doesn't exist, or can't take part as it was asked for."""
    for name in asked:
        if name not in AGENTS:
            raise UserError(f"no agent {name!r}: choose of {', '.join(AGENTS)}")
    if SB3 in asked and not is_installed():
        raise UserError(f"{LIBRARY} isn't installed: {HOW_TO_INSTALL}, or leave {SB3} out of --agents")
    if list(asked) == [SB3] and names_presets:
        raise UserError(f"{SB3} takes no preset: leave out --presets, or name another agent, too")
    if asked:
        return list(asked)
    if is_installed():
        return list(DEFAULT_AGENTS)
    typer.echo(f"{SB3} is left out, since {LIBRARY} isn't installed: {HOW_TO_INSTALL}", err=True)
    return [name for name in DEFAULT_AGENTS if name != SB3]


def _scenarios(corpus: Path | None, designs: int, seed: int) -> list[Scenario]:
    like = load_scenario(LIKE)
    return load_corpus(corpus, like) if corpus else [random_scenario(seed, number, like) for number in range(designs)]


def _run(folder: ExperimentFolder[BenchmarkConfig], output: Output, scheduler: SchedulerAddress | None) -> None:
    found = benchmark_of(folder.config, train_all(folder, output, scheduler))
    # Statistics and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.benchmark import write_benchmark

    with folder.writing():
        measures = write_benchmark(folder.path, found)
    figures = [{"contestant": name, **dataclasses.asdict(own)} for name, own in measures]
    say_end(output, folder.path, FILES, {"measures": figures}, _table(measures))


def benchmark_of(config: BenchmarkConfig, outcomes: Outcomes) -> Benchmark:
    """The results, contestant by contestant, design by design, trial by trial."""
    contestants = {contestant.name: contestant for contestant in config.contestants}
    rows: dict[tuple[str, str, int], BenchmarkRow] = {}
    seconds: dict[str, list[float]] = {name: [] for name in contestants}
    for job, outcome in outcomes:
        for group, scenario, number, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True):
            scores = [(row.episode, row.score) for row in run.evaluations]
            trial = trial_of(number)
            rows[group, scenario.name, trial] = BenchmarkRow(
                agent=contestants[group].agent,
                preset=contestants[group].short_preset,
                design=scenario.name,
                kind=kind_of_design(scenario.design),
                blocks=scenario.blocks,
                trial=trial,
                optimum=scenario.optimum,
                best_score=max(score for _, score in scores),
                played_to_optimum=played_to_optimum(scores, scenario.optimum),
                without_a_prior=round(episodes_without_a_prior(scenario.blocks, scenario.size), 2),
                updates=run.updates,
            )
            seconds[group].append(outcome.seconds / len(outcome.runs))
    return Benchmark(
        corpus=config.corpus,
        trials=config.trials,
        seed=config.seed,
        most_episodes={name: contestant.preset.episodes for name, contestant in contestants.items()},
        # In an order that doesn't depend on how the runs were divided into jobs.
        rows=[
            rows[name, design.name, trial]
            for name in contestants
            for design in config.designs
            for trial in range(config.trials)
        ],
        seconds=seconds,
    )


def _table(found: "Sequence[tuple[str, Measures]]") -> Table:
    heads = ("solved", "median", "interquartile mean", "worst", "without a prior", "within twice that")
    columns = (Column(head, overflow="fold") for head in ("episodes to the optimum", *heads))
    table = Table(*columns, box=None, padding=(0, 1))
    for name, measures in found:
        table.add_row(Text(name), *measures.in_words())
    return table
