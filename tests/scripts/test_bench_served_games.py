"""The benchmark of served games: the slowest game's clock counts, and all episodes that came back do."""

import json
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from scripts.bench_served_games import TrainingTime, main, train, trained_in


def saved(out: Path, score: float | None) -> Path:
    live = {"game_s": [61.5, 70.25, 55.0], "spoiled_episodes": 1}
    summary = {"final_scores": [score], "optimum": 21.0, "live": live}
    (out / "summary.json").write_text(json.dumps(summary), "utf-8")
    (out / "episodes.csv").write_text("trial,episode\n0,1\n0,2\n0,3\n", "utf-8")
    (out / "evaluations.csv").write_text("trial,episode\n0,2\n", "utf-8")
    return out


def test_the_slowest_games_clock_counts_and_both_tables_episodes_do(tmp_path: Path) -> None:
    found = trained_in(saved(tmp_path, 21.0))
    assert found == TrainingTime((61.5, 70.25, 55.0), episodes=4, lost=1, is_optimum=True)
    assert found.seconds == 70.25
    assert found.in_words() == "70 s (62, 70, 55), 4 episodes, 1 lost"


@pytest.mark.parametrize("score", [20.0, None])
def test_a_training_below_the_optimum_or_without_a_score_has_missed_it(score: float | None, tmp_path: Path) -> None:
    found = trained_in(saved(tmp_path, score))
    assert not found.is_optimum
    assert found.in_words().endswith("NO OPTIMUM")


@pytest.mark.slow
def test_two_served_games_reach_the_optimum_and_each_has_a_clock() -> None:
    found = train(load_scenario("line"), 3, games=2)
    assert found.is_optimum
    assert len(found.clocks) == 2
    assert found.seconds > 0


@pytest.mark.parametrize("option", ["--designs", "--seeds", "--games"])
def test_none_of_something_is_refused_in_a_line(
    option: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["bench_served_games.py", option, "0"])
    with pytest.raises(SystemExit, match="2"):
        main()
    assert "must be at least 1" in capsys.readouterr().err
