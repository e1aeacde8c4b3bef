"""``mc-nested reproduce --beyond``: what the paper says it could do and did not try, trained and judged."""

from rich.table import Table
from rich.text import Text

from mc_nested.cli.experiment import Outcomes, train_all
from mc_nested.cli.experiment_end import Reproduced, say_end
from mc_nested.cli.output import Output
from mc_nested.learn.experiments.beyond import Arm, BeyondConfig
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.report.beyond.arms import ArmResults, Arms
from mc_nested.workers.cluster.address import SchedulerAddress

FILES = {"report": "beyond.md", "plot": "beyond.png", "rows": "beyond.csv"}


def run_beyond(folder: ExperimentFolder[BeyondConfig], output: Output, scheduler: SchedulerAddress | None) -> None:
    """Train what is missing, and write the report; errors as train_all's."""
    outcomes = train_all(folder, output, scheduler)
    # Tests and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.beyond.files import write_beyond
    from mc_nested.report.beyond.text import in_words, trials_to_decide

    arms = arms_of(folder.config, outcomes)
    with folder.writing():
        claims = write_beyond(folder.path, arms, folder.config.trials, folder.config.seed)
    found = [
        {
            "letter": each.claim.letter,
            "claim": each.claim.title,
            "verdict": each.verdict.value,
            "trials": trials_to_decide(each),
        }
        for each in claims
    ]
    shown = Table("", "what the paper says it could do", "verdict", "trials to decide it", box=None, padding=(0, 1))
    for each in claims:
        shown.add_row(f"({each.claim.letter})", Text(each.claim.title), each.verdict.value, in_words(each))
    say_end(output, Reproduced, folder.path, FILES, {"claims": found}, shown)


def arms_of(config: BeyondConfig, outcomes: Outcomes) -> Arms:
    """The results of every arm."""
    results = [_results_of(arm, outcomes) for arm in config.arms]
    return {each.key: each for each in results}


def _results_of(arm: Arm, outcomes: Outcomes) -> ArmResults:
    scenario = arm.loaded_scenario()
    runs = {
        trial: (run, outcome)
        for job, outcome in outcomes
        for group, own, trial, run in zip(job.groups, job.scenarios, job.trials, outcome.runs, strict=True)
        if (group, own) == (arm.group, scenario)
    }
    in_order = [runs[trial] for trial in range(arm.trials)]
    return ArmResults(
        topic=arm.topic,
        name=arm.name,
        scenario=scenario.name,
        materials=len(scenario.materials),
        optimum=scenario.optimum,
        episodes=arm.preset.episodes,
        stops=arm.stop_at_optimum,
        team=arm.team,
        trials=[run.evaluations for run, _ in in_order],
        networks=in_order[0][1].networks,
        parameters=in_order[0][1].parameters,
        updates=sum(run.updates for run, _ in in_order),
        env_steps=sum(run.env_steps for run, _ in in_order),
        seconds=sum(outcome.seconds_of(run) for run, outcome in in_order),
        replay_bytes=[run.replay_bytes or 0 for run, _ in in_order],
    )
