"""``mc-nested play``: an episode that is watched, in the simulator and in a live game that fails."""

import json
import shutil
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, NotInFrontError, StoppedError
from tests.arena.made_games import TakesAtItsWord
from tests.cli.fragile_game import open_live
from tests.cli.running import run
from tests.cli.shown import objectives_shown


def test_play_shows_the_arena_and_the_score(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("play", trained, "--trial", "1") == 0
    printed = capsys.readouterr().out
    score = json.loads((trained / "summary.json").read_text())["final_scores"][1]
    assert f"score {score:g} of 21" in printed
    assert "still to build" in printed


@pytest.mark.parametrize("words", [["--quiet"], ["--json"]])
def test_play_with_quiet_or_json_prints_one_line(
    words: list[str], trained: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("play", trained, *words) == 0
    printed = capsys.readouterr()
    assert printed.out.count("\n") == 1
    assert "score" in printed.out
    assert printed.err == ""


def test_play_takes_the_best_trial_by_default(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("play", trained) == 0
    best = max(json.loads((trained / "summary.json").read_text())["final_scores"])
    assert f"score {best:g} of 21" in capsys.readouterr().out


def test_play_replaces_the_screenshots_of_an_earlier_episode(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "--episodes", "1", "--out", tmp_path / "run") == 0
    pictures = tmp_path / "run" / "screenshots"
    pictures.mkdir()
    (pictures / "999.png").touch()
    open_live(monkeypatch, float("inf"))
    assert run("play", tmp_path / "run", "--backend", "live", "--profile", "mine", "--screenshots") == 0
    steps = int(capsys.readouterr().out.split(" steps")[0].split()[-1])
    assert [path.name for path in sorted(pictures.iterdir())] == [f"{step:03d}.png" for step in range(1, steps + 1)]


@pytest.mark.parametrize(("failures", "code"), [(1, 0), (2, 0), (3, 2)])
def test_after_a_mishap_a_watched_episode_starts_over_twice_at_most(
    failures: int, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "--episodes", "1", "--out", tmp_path / "run") == 0
    open_live(monkeypatch, 5, LiveError("it lagged"), failures)
    capsys.readouterr()
    assert run("play", tmp_path / "run", "--backend", "live", "--profile", "mine") == code
    told = capsys.readouterr().err.splitlines()
    assert told.count("it lagged; the episode starts over") == min(failures, 2)
    assert ("mc-nested: it lagged" in told) is (code == 2)


@pytest.mark.parametrize("error", [StoppedError("stopped by f12"), NotInFrontError("another window")])
def test_an_episode_that_a_person_stops_does_not_start_over(
    error: LiveError, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "--episodes", "1", "--out", tmp_path / "run") == 0
    open_live(monkeypatch, 5, error, 1)
    capsys.readouterr()
    assert run("play", tmp_path / "run", "--backend", "live", "--profile", "mine") == 2
    assert capsys.readouterr().err == f"mc-nested: {error}\n"


def test_screenshots_in_the_simulator_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("train", "--episodes", "1", "--out", tmp_path / "run") == 0
    assert run("play", tmp_path / "run", "--screenshots") == 2
    assert "leave out --screenshots" in capsys.readouterr().err


def test_an_agent_with_objectives_shows_what_it_is_after_in_a_game(
    with_objectives: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(with_objectives, tmp_path / "run")
    open_live(monkeypatch, float("inf"))
    capsys.readouterr()
    shown = objectives_shown(monkeypatch)
    words = ["--backend", "live", "--profile", "mine", "--screenshots", "--json", "--video"]
    assert run("play", tmp_path / "run", *words, tmp_path / "film.gif") == 0
    found = json.loads(capsys.readouterr().out)
    *objectives, last = shown.filmed
    assert len(objectives) == found["steps"] == len(list((tmp_path / "run" / "screenshots").iterdir()))
    assert set(objectives) <= load_scenario("line").design
    assert last is None
    assert shown.drawn == shown.published == shown.filmed


def test_an_agent_with_objectives_announces_each_action(
    with_objectives: Path, opened_games: list[TakesAtItsWord], capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    assert run("play", with_objectives, "--json") == 0
    (game,) = opened_games
    assert game.acts == json.loads(capsys.readouterr().out)["steps"]
    assert game.kept == game.acts - 1
    assert game.following is None
