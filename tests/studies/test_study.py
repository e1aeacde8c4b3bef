"""A user's own study takes one file, here these lines."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli.output import Output
from mc_nested.cli.study import run_study
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond import with_materials
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.study import Report, Study, StudyOptions
from mc_nested.studies.table import markdown
from mc_nested.studies.trial import Trial, on_each, trial_table
from tests.cli.running import table

HEADER = ("agent", "scenario", "trial", "best_score", "optimum")


def arms(options: StudyOptions) -> list[Arm]:
    line = [with_materials(load_scenario("line"), 3)]
    preset = options.loaded_preset()
    return [Arm(agent, preset, line, options.trials, agent, options.preset) for agent in AGENT_SPECS]


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    best = {agent: max(trial.best_score for trial in own) for (agent, _), own in on_each(trials).items()}
    figure = Figure(figsize=(4, 3), dpi=100)
    figure.subplots().bar(list(best), list(best.values()))
    rows = [(agent, f"{score:g}") for agent, score in best.items()]
    text = ["# The line with three materials", f"Seed {config.seed}.", markdown(("agent", "best score"), rows)]
    return Report(text, figure, {"three.csv": trial_table(trials, HEADER)})


THREE_MATERIALS = Study(
    name="three-materials",
    what="Train every agent on the line with three materials.",
    options={"trials": 5, "episodes": None, "seed": 0},
    arms=arms,
    report=report,
    files={"report": "three.md", "plot": "three.png", "rows": "three.csv"},
)


def test_a_study_that_a_user_declares_trains_and_reports(tmp_path: Path) -> None:
    declared = THREE_MATERIALS.arms(StudyOptions(trials=1, episodes=2))
    folder = StudyFolder.new(tmp_path / "run", config_of("three-materials", declared, trials=1, seed=0, jobs=1))
    run_study(THREE_MATERIALS, folder, Output(quiet=True))
    text = (tmp_path / "run" / "three.md").read_text("utf-8")
    assert text.startswith("# The line with three materials\n\nSeed 0.\n\n| agent | best score |\n")
    assert (tmp_path / "run" / "three.png").stat().st_size > 1000
    rows = table(tmp_path / "run" / "three.csv")
    assert [(row["agent"], row["scenario"], row["trial"]) for row in rows] == [
        (agent, "line, 3 materials", "0") for agent in AGENT_SPECS
    ]
