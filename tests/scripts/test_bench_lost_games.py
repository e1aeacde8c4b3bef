"""The benchmark of lost games finds what it is there to find: what is counted twice, and what is missing."""

from collections import Counter
from pathlib import Path

from scripts.bench_lost_games import GAMES, counted_in, judged

PLAYED = Counter({"21": 5, "10": 4})
STOPPED = 130


def test_what_was_played_and_counted_once_is_right() -> None:
    assert judged(PLAYED, PLAYED, 0, STOPPED) == []


def test_an_episode_that_is_counted_twice_is_found() -> None:
    (wrong,) = judged(PLAYED + Counter(["10"]), PLAYED, 3, STOPPED)
    assert wrong.endswith("scores {'10': 1}")


def test_a_whole_episode_may_be_missing_only_if_the_learner_has_lost_one() -> None:
    played = PLAYED + Counter({"8": len(GAMES) + 1})
    assert judged(PLAYED, played, 1, STOPPED) == []
    (wrong,) = judged(PLAYED, played, 0, STOPPED)
    assert wrong == f"{len(GAMES) + 1} whole episodes are missing, and the learner has lost 0"


def test_a_learner_that_ended_by_itself_is_wrong() -> None:
    (wrong,) = judged(PLAYED, PLAYED, 0, 1)
    assert "exit code 1" in wrong


def test_both_tables_count(tmp_path: Path) -> None:
    (tmp_path / "episodes.csv").write_text("trial,episode,score\n0,1,10.0\n0,2,-5.0\n", "utf-8")
    (tmp_path / "evaluations.csv").write_text("trial,episode,score\n0,2,21.0\n", "utf-8")
    assert counted_in(tmp_path) == Counter(["10", "-5", "21"])
