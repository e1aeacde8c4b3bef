"""``mc-nested study NAME``: the shipped studies, each with the options that it takes.

A study's options and their defaults are its declaration's; what each means stands here once.
"""

import importlib
from collections.abc import Callable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import partial
from inspect import Parameter, Signature
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Column
from rich.table import Table as RichTable
from rich.text import Text

from mc_nested.arena.design import MOST_DESIGNS
from mc_nested.arena.scenario_file import paper_scenarios
from mc_nested.cli.cluster_options import ClusterOption, InsecureOption, KeysOption, cluster_of
from mc_nested.cli.completion import complete_of, complete_runs
from mc_nested.cli.options import (
    MOST_TRIALS,
    DeviceOption,
    EngineOption,
    LayerOption,
    PresetOption,
    ScenariosOption,
    is_given,
    named_scenario,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.study_run import MOST_JOBS, jobs_at_once, train_all
from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import MOST, shipped_presets
from mc_nested.learn.runs.folder_kind import verb_of_study
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.studies.arm import AGENTS, Arm
from mc_nested.studies.config import config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.study import SHIPPED, Study, StudyOptions, write_report
from mc_nested.studies.table import Table
from mc_nested.studies.trial import trials_of
from mc_nested.workers.cluster.address import SchedulerAddress
from sim.worlds import check_window

OPTIONS: Mapping[str, Any] = {
    "trials": Annotated[int, typer.Option(min=1, max=MOST_TRIALS, help="trials of each variant on each design")],
    "episodes": Annotated[int | None, typer.Option(min=1, max=MOST, help="episodes a trial, if not the preset's")],
    "seed": Annotated[int, typer.Option(min=0, help="the same seed gives the same results")],
    "scenario": ScenariosOption,
    "layer": LayerOption,
    "agent": Annotated[
        list[str] | None,
        typer.Option(
            help="an agent, as often as you like",
            show_default=", ".join(AGENT_SPECS),
            autocompletion=complete_of(lambda: AGENT_SPECS),
        ),
    ],
    "preset": PresetOption,
    "engine": EngineOption,
    "device": DeviceOption,
    "longer": Annotated[
        int | None,
        typer.Option(
            min=2, max=1000, help="also train nested and hierarchical on zigzag and diamond so many times as long"
        ),
    ],
    "designs": Annotated[int, typer.Option(min=1, max=MOST_DESIGNS, help="random designs, drawn from the seed")],
    "corpus": Annotated[
        Path | None, typer.Option(metavar="FILE", help="a TOML file of drawings instead of random designs")
    ],
    "agents": Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME,...",
            help=f"of {', '.join(AGENTS)}",
            show_default="nested, and sb3 where it is installed",
            autocompletion=complete_of(lambda: AGENTS),
        ),
    ],
    "presets": Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME|FILE,...",
            help="of each agent",
            show_default="model-based,tuned,paper",
            autocompletion=complete_of(shipped_presets),
        ),
    ],
}
"""What a study's options are, by the names that its declaration gives them."""

EVERY_STUDY: Mapping[str, tuple[Any, Any]] = {
    "jobs": (
        Annotated[
            int | None,
            typer.Option(
                min=1, max=MOST_JOBS, help="processes to train in; for a cluster, jobs", show_default="its cores"
            ),
        ],
        None,
    ),
    "cluster": (ClusterOption, None),
    "keys": (KeysOption, None),
    "insecure": (InsecureOption, False),
    "out": (
        Annotated[
            Path | None,
            typer.Option(
                metavar="DIR",
                help="a new or empty folder for all of it",
                show_default="one under runs, with the date",
            ),
        ],
        None,
    ),
    "resume": (
        Annotated[
            Path | None,
            typer.Option(metavar="DIR", help="go on where it was stopped or killed", autocompletion=complete_runs),
        ],
        None,
    ),
    "quiet": (QuietOption, False),
    "as_json": (JsonOption, False),
}
"""The options that every study takes, and their defaults."""

BESIDE_RESUME = ("resume", "cluster", "keys", "insecure", "quiet", "as_json")
"""The options that a study can be resumed with."""


@dataclass(frozen=True)
class Studied:
    """What a study prints."""

    folder: Annotated[Path, "its folder"]
    files: Annotated[Mapping[str, Path], "what was written, by what it is"]


@dataclass(frozen=True)
class Judged(Studied):
    """What a study prints that judges the paper's claims."""

    claims: Annotated[
        Sequence[object],
        "letter, claim and verdict of each; robustness adds choices, the verdict under each; beyond and objectives add "
        "trials, how many would decide it, or null for more than 1,000 and for what is counted",
    ]


@dataclass(frozen=True)
class Measured(Studied):
    """What a benchmark prints."""

    measures: Annotated[Sequence[object], "of each contestant: trials, solved, and its episodes to the optimum"]


RESULTS: Mapping[str, type[Studied]] = {
    "reproduce": Judged,
    "robustness": Judged,
    "beyond": Judged,
    "objectives": Judged,
    "benchmark": Measured,
}
"""What a study prints that has more than its files to show."""

app = typer.Typer(help="Train and report on one of several studies; Ctrl+C saves, and --resume goes on from there.")


def declared(name: str) -> Study:
    """Return the shipped study of that name."""
    found: Study = importlib.import_module(f"mc_nested.studies.{name}").STUDY
    return found


def command_of(study: Study) -> Callable[..., None]:
    """Return the command that runs the study."""

    def command(context: typer.Context, **values: Any) -> None:
        given = {name for name in values if is_given(context, name)}
        output = Output(values["quiet"], values["as_json"])
        scheduler = cluster_of(values["cluster"], values["keys"], values["insecure"])
        if values["resume"] is not None:
            for name in sorted(given - set(BESIDE_RESUME)):
                raise UserError(f"--resume goes on with its own config.toml: leave out --{name.replace('_', '-')}")
            folder = StudyFolder.open(values["resume"], [verb_of_study(study.name)])
            with folder_lock(values["resume"]):
                run_study(study, folder, output, scheduler)
            return
        options = _options_of(study, values, given)
        arms = _checked_arms(study, options)
        config = config_of(
            study.name,
            arms,
            trials=options.trials,
            seed=options.seed,
            jobs=values["jobs"] or jobs_at_once(scheduler, output),
            notes=study.notes(options),
        )
        with output_folder(values["out"], study.folder or study.name) as path:
            run_study(study, StudyFolder.new(path, config), output, scheduler)

    own = {name: (OPTIONS[name], default) for name, default in study.options.items()}
    parameters = [Parameter("context", Parameter.POSITIONAL_OR_KEYWORD, annotation=typer.Context)]
    for name, (kind, default) in {**own, **EVERY_STUDY}.items():
        parameters.append(Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=kind))
    command.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    command.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    writes = ", ".join(study.files.values())
    command.__doc__ = f"{study.what}\n\nCtrl+C saves, and --resume goes on from there. Writes {writes}."
    return prints(RESULTS.get(study.name, Studied))(command)


def _checked_arms(study: Study, options: StudyOptions) -> Sequence[Arm]:
    """Return what is trained; UserError if that can't be, or not here."""
    arms = study.arms(options)
    for arm in arms:
        check_window(arm.preset.states, has_window=False)
        arm.check()
    if options.device:
        from mc_nested.learn.dqn.torch_engine.engine import device_named  # torch takes seconds to load

        device_named(options.device)
    return arms


def _options_of(study: Study, values: Mapping[str, Any], given: AbstractSet[str]) -> StudyOptions:
    """Return what was asked for, with the designs and the names of lists loaded and taken apart."""
    own = {name: values[name] for name in study.options if name not in ("scenario", "layer")}
    if "scenario" in study.options:
        names = values["scenario"] or paper_scenarios()
        own["scenarios"] = [named_scenario(name, values["layer"]) for name in names]
    for name in ("agents", "presets"):
        if name in own:
            own[name] = _listed(own[name])
    own = {name: value for name, value in own.items() if value is not None}
    return StudyOptions(**own, given=frozenset(given), say=partial(typer.echo, err=True))


def _listed(options: Sequence[str] | None) -> list[str]:
    """Return the names of an option that can be repeated, each with commas between names; each name once."""
    return list(dict.fromkeys(name.strip() for option in options or () for name in option.split(",")))


def run_study(study: Study, folder: StudyFolder, output: Output, scheduler: SchedulerAddress | None = None) -> None:
    """Train what is missing, write the report and say where it is; errors as ``train_all``'s."""
    outcomes = train_all(folder, output, scheduler)
    report = study.report(folder.config, trials_of(folder.config.loaded_arms(), outcomes))
    with folder.writing():
        write_report(folder.path, study, report)
    paths = {what: folder.path / name for what, name in study.files.items()}
    lines = [f"{what + ':':8}{path}" for what, path in paths.items()]
    shown = [_shown(report.shown)] if report.shown else []
    output.result(RESULTS.get(study.name, Studied)(folder.path, paths, **report.found), *shown, *lines)
    output.hint(f"next:   open {next(iter(paths.values()))}")


def _shown(table: Table) -> RichTable:
    columns = (Column(head, overflow="fold") for head in table.header)
    shown = RichTable(*columns, box=None, padding=(0, 1))
    for row in table.rows:
        shown.add_row(*map(Text, row))
    return shown


for _name in SHIPPED:
    app.command(_name)(command_of(declared(_name)))
