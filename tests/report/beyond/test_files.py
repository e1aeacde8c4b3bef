"""The files of --beyond: the same for the same results, and what they say."""

import csv
from pathlib import Path

import cv2

from mc_nested.report.beyond.files import write_beyond
from mc_nested.report.beyond.text import in_words
from tests.report.beyond.made_arms import whole


def test_the_same_results_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        write_beyond(tmp_path / name, whole(), 10, 0)
    for name in ("beyond.md", "beyond.png", "beyond.csv"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_the_report_has_every_claim_with_its_verdict_and_its_trials(tmp_path: Path) -> None:
    claims = write_beyond(tmp_path, whole(), 10, 7)
    text = (tmp_path / "beyond.md").read_text("utf-8")
    assert "Seed 7: 10 trials" in text
    for judged in claims:
        claim = judged.claim
        row = f"| ({claim.letter}) | {claim.title} | **{judged.verdict.value}** | {in_words(judged)} |"
        assert row in text
        assert f'The paper, section {claim.section}: "{claim.paper}".' in text
    assert "last ten until 1,200 steps" in text
    assert "last ten until 1,080 updates" in text


def test_arms_that_end_at_the_optimum_have_no_last_ten_and_few_trials_are_said(tmp_path: Path) -> None:
    write_beyond(tmp_path, whole(), 10, 0)
    text = (tmp_path / "beyond.md").read_text("utf-8")
    assert "| zigzag | images | 3 | 360 | - | - | 14.83 |" in text
    assert "| flag | nested | 10 | 360 | 15.00 |" in text
    assert text.count("3 trials are too few for any test") == 1
    write_beyond(tmp_path, whole(image_trials=10), 10, 0)
    assert "too few for any test" not in (tmp_path / "beyond.md").read_text("utf-8")


def test_every_evaluation_is_a_row(tmp_path: Path) -> None:
    arms = whole(trials=2)
    write_beyond(tmp_path, arms, 2, 0)
    with (tmp_path / "beyond.csv").open(newline="", encoding="utf-8") as file:
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
