"""The files of --beyond: the same for the same results, and what they say."""

import csv
from pathlib import Path

import cv2
import pytest

from mc_nested.report.beyond.claims import judge_beyond
from mc_nested.report.beyond.files import write_beyond
from mc_nested.report.beyond.text import beyond_text, in_words
from mc_nested.report.verdicts import JudgedClaim
from tests.report.beyond.made_arms import whole


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, tuple[JudgedClaim, ...]]:
    """The folder of a whole run of ten trials, seed 7, and its claims."""
    folder = tmp_path_factory.mktemp("beyond")
    return folder, write_beyond(folder, whole(), 10, 7)


def test_the_same_results_give_the_same_bytes(written: tuple[Path, object], tmp_path: Path) -> None:
    write_beyond(tmp_path, whole(), 10, 7)
    for name in ("beyond.md", "beyond.png", "beyond.csv"):
        assert (tmp_path / name).read_bytes() == (written[0] / name).read_bytes()


def test_the_report_has_every_claim_with_its_verdict_and_its_trials(
    written: tuple[Path, tuple[JudgedClaim, ...]],
) -> None:
    folder, claims = written
    text = (folder / "beyond.md").read_text("utf-8")
    assert "Seed 7: 10 trials" in text
    for judged in claims:
        claim = judged.claim
        row = f"| ({claim.letter}) | {claim.title} | **{judged.verdict.value}** | {in_words(judged)} |"
        assert row in text
        assert f'The paper, section {claim.section}: "{claim.paper}".' in text
    assert "last ten until 1,200 steps" in text
    assert "last ten until 1,080 updates" in text


def test_arms_that_end_at_the_optimum_have_no_last_ten_and_few_trials_are_said(written: tuple[Path, object]) -> None:
    text = (written[0] / "beyond.md").read_text("utf-8")
    assert "| zigzag | images | 3 | 360 | - | - | 14.83 |" in text
    assert "| flag | nested | 10 | 360 | 15.00 |" in text
    assert text.count("3 trials are too few for any test") == 1
    enough = whole(image_trials=10)
    assert "too few for any test" not in beyond_text(enough, judge_beyond(enough), 10, 0)


def test_every_evaluation_is_a_row(written: tuple[Path, object]) -> None:
    arms = whole()
    with (written[0] / "beyond.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == sum(len(trial) for arm in arms.values() for trial in arm.trials)
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


def test_one_trial_is_drawn_and_reported_without_intervals(tmp_path: Path) -> None:
    write_beyond(tmp_path, whole(trials=1, image_trials=1), 1, 0)
    drawn = cv2.imread(str(tmp_path / "beyond.png"))
    assert drawn is not None
    assert drawn.shape[1] > 1000
    assert "one trial of each agent" in (tmp_path / "beyond.md").read_text("utf-8")
