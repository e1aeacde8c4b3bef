"""The study of objectives: what is trained, which way its verdicts fall, its report, and a short run with a resume."""

import json
from dataclasses import replace
from pathlib import Path

import cv2
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.studies.beyond import report_on
from mc_nested.studies.claims.beyond import judge_beyond
from mc_nested.studies.config import config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.objectives import COUNTS, STUDY, arms, with_objectives
from mc_nested.studies.study import StudyOptions, write_report
from mc_nested.studies.verdicts import Verdict
from tests.cli.running import run, table
from tests.learn.made_experiments import small_preset
from tests.studies.claims.made_arms import many_main_actions

TRIALS = 8


def means_where_the_lead_changes_by(change: float) -> dict[str, Verdict]:
    """Return the verdicts where nested's lead on both others changes by so much from one number to the next."""
    made = many_main_actions(
        "objectives",
        (2, 3, 4),
        lambda _, agent, count: 12.0 + change * count if agent == "nested" else 10.0,
        TRIALS,
    )
    return {each.claim.letter: each.verdict for each in judge_beyond(made)}


def test_with_objectives_the_blocks_on_the_design_are_the_score() -> None:
    found = with_objectives(load_scenario("diamond"), 16)
    assert (len(found.materials), found.optimum, found.regions) == (16, 16.0, True)
    assert [part.cells for part in found.parts] == [found.design]


def test_each_agent_has_each_number_of_objectives_and_learns_with_the_same_preset() -> None:
    found = arms(StudyOptions(trials=10, episodes=7))
    wanted = [(agent, count) for count in COUNTS for agent in ("nested", "hierarchical", "single")]
    assert [(arm.agent, len(arm.scenarios[0].materials)) for arm in found] == wanted
    assert {arm.preset.episodes for arm in found} == {7}
    assert all(arm.preset == found[0].preset for arm in found)
    assert {arm.trials for arm in found} == {10}


def test_claims_of_a_growing_lead_hold_where_it_grows_and_fail_where_it_shrinks() -> None:
    letters = [f"n{number}" for number in range(1, 8)]
    assert means_where_the_lead_changes_by(2.0) == dict.fromkeys(letters, Verdict.HOLDS)
    shrinks = means_where_the_lead_changes_by(-2.0)
    assert shrinks.pop("n7") is Verdict.HOLDS, "networks grow all the same"
    assert shrinks == dict.fromkeys(letters[:-1], Verdict.FAILS)


def test_claims_of_a_growing_lead_stay_undecided_where_it_stays() -> None:
    found = means_where_the_lead_changes_by(0.0)
    assert {found[f"n{number}"] for number in range(1, 7)} == {Verdict.UNDECIDED}


def test_the_report_has_the_claims_what_each_needs_and_a_figure(tmp_path: Path) -> None:
    made = many_main_actions("objectives", COUNTS)
    write_report(tmp_path, STUDY, report_on("objectives", made, 10, 7))
    text = (tmp_path / "objectives.md").read_text("utf-8")
    assert text.startswith("# Many main actions: objectives\n\nSeed 7: 10 trials")
    assert "| 225 | hierarchical | 15.00 |" in text
    assert "| 226 | 226,000 |" in text
    assert "## Images" not in text
    drawn = cv2.imread(str(tmp_path / "objectives.png"))
    assert drawn is not None
    assert drawn.shape[1] > 1000


@pytest.mark.slow
def test_a_short_study_is_resumed_and_leaves_its_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    small = [replace(arm, preset=small_preset(10)) for arm in arms(StudyOptions(trials=2, episodes=10))]
    out = tmp_path / "run"
    StudyFolder.new(out, config_of("objectives", small, trials=2, seed=0, jobs=1)).begin()
    assert run("study", "objectives", "--resume", out, "--json") == 0
    claims = {each["letter"]: each["verdict"] for each in json.loads(capsys.readouterr().out)["claims"]}
    assert list(claims) == [f"n{number}" for number in range(1, 8)]
    assert claims["n7"] == "holds"
    rows = table(out / "objectives.csv")
    found = {(row["scenario"], row["agent"], row["trial"]) for row in rows}
    assert found == {
        (f"diamond, {count} objectives", agent, trial)
        for count in COUNTS
        for agent in ("nested", "hierarchical", "single")
        for trial in "01"
    }
    assert (out / "objectives.md").exists()
