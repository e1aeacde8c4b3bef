"""``mc-nested reproduce``: the paper's experiment, every agent on every design, and tests of its claims."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.table import Table
from rich.text import Text

from mc_nested.arena.scenario_file import paper_scenarios, table_of
from mc_nested.cli.beyond import run_beyond
from mc_nested.cli.cluster_options import ClusterOption, InsecureOption, KeysOption, cluster_of
from mc_nested.cli.experiment import (
    MOST_TRIALS,
    JobsOption,
    Outcomes,
    OutOption,
    ResumeOption,
    SeedOption,
    check_nothing_beside,
    check_nothing_beside_resume,
    jobs_at_once,
    train_all,
)
from mc_nested.cli.experiment_end import Reproduced, say_end
from mc_nested.cli.experiment_results import results_of_groups
from mc_nested.cli.options import (
    DeviceOption,
    EngineOption,
    LayerOption,
    PresetOption,
    ScenariosOption,
    named_scenarios,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.robustness import run_robustness
from mc_nested.errors import RunError, UserError
from mc_nested.learn.agents import AGENT_SPECS, check_exploration, check_parts
from mc_nested.learn.experiments.beyond import FEW, BeyondConfig, shipped_arms
from mc_nested.learn.experiments.experiment_folder import CONFIG, ExperimentFolder
from mc_nested.learn.experiments.reproduction import LONGER, LONGER_AGENTS, LONGER_SCENARIOS, ReproduceConfig
from mc_nested.learn.experiments.robustness import RobustnessConfig, shipped_choices
from mc_nested.learn.preset import MOST, load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.results import Results
from mc_nested.toml_file import parse_document, read_toml_text
from mc_nested.workers.cluster.address import SchedulerAddress
from sim.worlds import check_window

if TYPE_CHECKING:  # it loads scipy, which a process that only waits for others doesn't need
    from collections.abc import Sequence

    from mc_nested.report.verdicts import JudgedClaim

VERB = "reproduce"
TRIALS, PRESET = 10, "paper"

BESIDE_BEYOND = (
    "beyond",
    "trials",
    "episodes",
    "seed",
    "device",
    "jobs",
    "cluster",
    "keys",
    "insecure",
    "out",
    "quiet",
    "as_json",
)
"""The options that --beyond takes."""

FILES = {"report": "report.md", "figure": "figure5.png", "table": "results.csv"}


@prints(Reproduced)
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
    preset: PresetOption = None,
    engine: EngineOption = None,
    device: DeviceOption = None,
    longer: Annotated[
        int | None,
        typer.Option(
            min=2,
            max=1000,
            help="also train nested and hierarchical on zigzag and diamond so many times as long [no]",
        ),
    ] = None,
    robustness: Annotated[
        bool,
        typer.Option("--robustness", help="judge the claims again under each of the paper's open choices instead"),
    ] = False,
    beyond: Annotated[
        bool,
        typer.Option(
            "--beyond", help="try what the paper says it could do instead: images, several and many main actions, teams"
        ),
    ] = False,
    jobs: JobsOption = None,
    cluster: ClusterOption = None,
    keys: KeysOption = None,
    insecure: InsecureOption = False,
    out: OutOption = None,
    resume: ResumeOption = None,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Repeat the paper's experiment and test its claims; Ctrl+C saves, and --resume goes on from there.

    Writes figure5.png and figure5.svg, results.csv and report.md, or robustness.*, or beyond.*. The defaults take some
    minutes on two cores, those of --beyond about an hour, those of --robustness somewhat more.
    """
    output = Output(quiet, as_json)
    scheduler = cluster_of(cluster, keys, insecure)
    if resume is not None:
        check_nothing_beside_resume(context.params)
        _resume(resume, output, scheduler)
        return
    if beyond:
        check_nothing_beside(context.params, BESIDE_BEYOND, "--beyond has agents, designs and presets of its own")
        arms = shipped_arms(trials or TRIALS, trials or FEW, episodes, device)
        check_device(device)
        beyond_config = BeyondConfig(
            trials=trials or TRIALS, seed=seed or 0, jobs=jobs or jobs_at_once(scheduler, output), arms=arms
        )
        with output_folder(out, "beyond") as path:
            run_beyond(ExperimentFolder.new(path, beyond_config, VERB), output, scheduler)
        return
    if robustness and (agent or longer):
        raise UserError("--robustness judges all three agents, and not claim (f): leave out --agent and --longer")
    for name in agent or ():
        if name not in AGENT_SPECS:
            raise UserError(f"no agent {name!r}: choose one of {', '.join(AGENT_SPECS)}")
    chosen = load_preset(preset or PRESET).changed(engine=engine, device=device)
    check_window(chosen.states, has_window=False)
    for name in agent or AGENT_SPECS:
        check_exploration(AGENT_SPECS[name], chosen)
    check_device(device)
    chosen = chosen.model_copy(update={"episodes": episodes or chosen.episodes})
    scenarios = named_scenarios(scenario or paper_scenarios(), layer)
    check_parts(scenarios, chosen)
    if robustness:
        robustness_config = RobustnessConfig(
            trials=trials or TRIALS,
            seed=seed or 0,
            jobs=jobs or jobs_at_once(scheduler, output),
            preset_name=preset or PRESET,
            preset=chosen,
            scenarios=[table_of(each) for each in scenarios],
            choices=shipped_choices(chosen, scenarios),
        )
        with output_folder(out, "robustness") as path:
            run_robustness(ExperimentFolder.new(path, robustness_config, VERB), output, scheduler)
        return
    config = ReproduceConfig(
        agents=[name for name in AGENT_SPECS if name in agent] if agent else list(AGENT_SPECS),
        trials=trials or TRIALS,
        seed=seed or 0,
        jobs=jobs or jobs_at_once(scheduler, output),
        longer=longer or 0,
        preset_name=preset or PRESET,
        preset=chosen,
        scenarios=[table_of(each) for each in scenarios],
    )
    if longer and not (config.longer_agents and config.longer_scenarios):
        raise UserError(
            f"--longer is for {' and '.join(LONGER_AGENTS)} on {' and '.join(LONGER_SCENARIOS)}: "
            f"leave it out, or name one of each"
        )
    with output_folder(out, "figure5") as path:
        _run(ExperimentFolder.new(path, config, VERB), output, scheduler)


def check_device(device: str | None) -> None:
    """PresetError if torch knows no such device here: before anything is written."""
    if device:
        from mc_nested.learn.dqn.torch_engine.engine import device_named  # torch takes seconds to load

        device_named(device)


def _resume(path: Path, output: Output, scheduler: SchedulerAddress | None) -> None:
    """Go on with any of the three kinds, which a key of config.toml tells apart."""
    file = path / CONFIG
    keys = parse_document(read_toml_text(file, RunError), str(file), RunError) if file.is_file() else {}
    if "choices" in keys:
        robustness = ExperimentFolder.open(path, RobustnessConfig, VERB)
        with folder_lock(path):
            run_robustness(robustness, output, scheduler)
    elif "arms" in keys:
        beyond = ExperimentFolder.open(path, BeyondConfig, VERB)
        with folder_lock(path):
            run_beyond(beyond, output, scheduler)
    else:
        folder = ExperimentFolder.open(path, ReproduceConfig, VERB)
        with folder_lock(path):
            _run(folder, output, scheduler)


def _run(folder: ExperimentFolder[ReproduceConfig], output: Output, scheduler: SchedulerAddress | None) -> None:
    outcomes = train_all(folder, output, scheduler)
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
    say_end(output, Reproduced, folder.path, FILES, found, _verdicts(claims))


def results_of(config: ReproduceConfig, outcomes: Outcomes) -> tuple[Results, Results | None]:
    """The experiment's results, and those of its longer runs if there are any."""
    scenarios = config.loaded_scenarios()
    usual = results_of_groups(config, config.preset, scenarios, {agent: agent for agent in config.agents}, outcomes)
    if not config.longer:
        return usual, None
    of_longer = [scenario for scenario in scenarios if scenario.name in config.longer_scenarios]
    groups = {agent + LONGER: agent for agent in config.longer_agents}
    return usual, results_of_groups(config, config.longer_preset, of_longer, groups, outcomes)


def _verdicts(claims: "Sequence[JudgedClaim]") -> Table:
    table = Table("", "the paper's claim", "verdict", box=None, padding=(0, 1))
    for judged in claims:
        table.add_row(f"({judged.claim.letter})", Text(judged.claim.title), judged.verdict.value)
    return table
