"""``mc-nested reproduce --robustness``: the paper's claims judged again under each of its open choices."""

from collections import Counter

from rich.table import Table
from rich.text import Text

from mc_nested.cli.experiment import Outcomes, train_all
from mc_nested.cli.experiment_end import Reproduced, say_end
from mc_nested.cli.experiment_results import results_of_groups
from mc_nested.cli.output import Output
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.learn.experiments.robustness import Choice, RobustnessConfig
from mc_nested.report.results import Results
from mc_nested.workers.cluster.address import SchedulerAddress

FILES = {"table": "robustness.md", "plot": "robustness.png", "rows": "robustness.csv"}


def run_robustness(
    folder: ExperimentFolder[RobustnessConfig], output: Output, scheduler: SchedulerAddress | None
) -> None:
    """Train what is missing, and write the report; errors as train_all's."""
    outcomes = train_all(folder, output, scheduler)
    # Tests and plots take memory and a second to load: not while everything trains.
    from mc_nested.report.robustness import write_robustness
    from mc_nested.report.robustness_results import judged_under

    found = [
        judged_under(choice.choice, choice.value, results_under(choice, folder.config, outcomes))
        for choice in folder.config.choices
    ]
    with folder.writing():
        write_robustness(folder.path, found)
    claims = [
        {
            "letter": base.claim.letter,
            "claim": base.claim.title,
            "verdict": base.verdict.value,
            "choices": {each.name: each.verdicts[base.claim.letter].value for each in found[1:]},
        }
        for base in found[0].claims
    ]
    shown = Table("", "the paper's claim", "as it is", "under the other choices", box=None, padding=(0, 1))
    for base in found[0].claims:
        counted = Counter(each.verdicts[base.claim.letter].value for each in found[1:])
        others = ", ".join(f"{count} {verdict}" for verdict, count in sorted(counted.items()))
        shown.add_row(f"({base.claim.letter})", Text(base.claim.title), base.verdict.value, others)
    say_end(output, Reproduced, folder.path, FILES, {"claims": claims}, shown)


def results_under(choice: Choice, config: RobustnessConfig, outcomes: Outcomes) -> Results:
    """The results of all agents under that choice."""
    return results_of_groups(
        config,
        choice.preset_from(config.preset),
        [choice.scenario_from(scenario) for scenario in config.loaded_scenarios()],
        {choice.group(agent): agent for agent in AGENT_SPECS},
        outcomes,
    )
