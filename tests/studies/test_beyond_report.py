"""The report of study beyond: its content, and the same for the same results."""

from pathlib import Path

import cv2
import pytest

from mc_nested.studies.beyond import STUDY, in_words, report_on
from mc_nested.studies.claims.arm_results import Arms
from mc_nested.studies.claims.beyond import judge_beyond
from mc_nested.studies.study import write_report
from tests.cli.running import table
from tests.studies.claims.made_arms import whole


def write(folder: Path, arms: Arms, trials: int, seed: int) -> None:
    write_report(folder, STUDY, report_on("beyond", arms, trials, seed))


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a whole run of ten trials, seed 7."""
    folder = tmp_path_factory.mktemp("beyond")
    write(folder, whole(), 10, 7)
    return folder


def test_the_same_results_give_the_same_bytes(written: Path, tmp_path: Path) -> None:
    write(tmp_path, whole(), 10, 7)
    for name in ("beyond.md", "beyond.png", "beyond.csv"):
        assert (tmp_path / name).read_bytes() == (written / name).read_bytes()


def test_the_report_has_every_claim_with_its_verdict_and_its_trials(written: Path) -> None:
    claims = judge_beyond(whole())
    text = (written / "beyond.md").read_text("utf-8")
    assert "Seed 7: 10 trials" in text
    for judged in claims:
        claim = judged.claim
        row = f"| ({claim.letter}) | {claim.title} | **{judged.words}** | {in_words(judged)} |"
        assert row in text
        assert f'The paper, section {claim.section}: "{claim.paper}".' in text
    assert "last ten until 1,200 steps" in text
    assert "last ten until 1,080 updates" in text


def test_arms_that_stop_at_the_optimum_show_no_last_ten_and_few_trials_are_noted(written: Path) -> None:
    text = (written / "beyond.md").read_text("utf-8")
    assert "| zigzag | images | 3 | 360 | - | - | 14.83 |" in text
    assert "| flag | nested | 10 | 360 | 15.00 |" in text
    assert text.count("3 trials are too few for any test") == 1
    enough = whole(image_trials=10)
    assert "too few for any test" not in "\n".join(report_on("beyond", enough, 10, 0).text)


def test_the_csv_file_has_a_row_for_every_evaluation(written: Path) -> None:
    arms = whole()
    rows = table(written / "beyond.csv")
    assert len(rows) == sum(len(trial.scores) for arm in arms.values() for trial in arm.trials)
    assert rows[0] == {
        "topic": "images",
        "scenario": "line",
        "agent": "images",
        "trial": "0",
        "episode": "30",
        "score": "14.5",
        "material": "stone",
        "steps": "20",
        "trained_steps": "100",
        "updates": "90",
    }


def test_a_single_trial_is_drawn_and_reported(tmp_path: Path) -> None:
    write(tmp_path, whole(trials=1, image_trials=1), 1, 0)
    drawn = cv2.imread(str(tmp_path / "beyond.png"))
    assert drawn is not None
    assert drawn.shape[1] > 1000
    assert "one trial of each agent" in (tmp_path / "beyond.md").read_text("utf-8")
