"""Opening a world: the simulator at once; a live game is one arena; what sees a window needs one."""

import json
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.live.session import Opening
from sim.grid import GridVectorEnv
from sim.worlds import Backend, open_arenas, open_game
from tests.cli.running import run
from tests.learn.made_experiments import BAR, DOT

NOBODY = Opening("nobody", print)

SMALL = """
name = "small"
start = [2, 0]
step_limit = 4
design = '''
.....
.....
..#..
.....
.....
'''
[[materials]]
name = "stone"
p = 1
block = "stone"
"""

TRAIN = ["train", "--preset", "image", "--states", "screen", "--scenario", "small.toml", "--episodes", "2"]


def test_the_simulator_has_no_window_and_no_log() -> None:
    with open_game(Backend.SIM, DOT, NOBODY) as (game, display):
        assert (game.reset(0), display) == ((7, 13), None)
    with open_arenas(Backend.SIM, [DOT, BAR], NOBODY) as (env, log):
        assert isinstance(env, GridVectorEnv)
        assert (env.num_envs, log) == (2, None)


def test_the_live_backend_refuses_two_arenas() -> None:
    with pytest.raises(RunError, match="one arena, not 2"), open_arenas(Backend.LIVE, [DOT, BAR], NOBODY):
        pass


def test_an_agent_trained_on_the_windows_pictures_plays_as_well_in_its_window(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.toml").write_text(SMALL)
    assert run(*TRAIN, "--backend", "virtual", "--trials", "2", "--out", "run", "--json") == 0
    summary = json.loads(capsys.readouterr().out)
    assert len(summary["final_scores"]) == 2
    assert 'states = "screen"' in (tmp_path / "run/config.toml").read_text()
    assert run("play", "run", "--backend", "virtual", "--json") == 0
    played = json.loads(capsys.readouterr().out)
    assert played["score"] == max(summary["final_scores"])


@pytest.mark.parametrize(
    "words",
    [
        TRAIN,
        ["reproduce", "--preset", "screen.toml", "--trials", "1"],
        ["study", "sweep", "--preset", "screen.toml", "--trials", "1"],
        ["study", "benchmark", "--presets", "screen.toml", "--agents", "nested"],
    ],
    ids=" ".join,
)
def test_screen_states_are_refused_in_the_simulator(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.toml").write_text(SMALL)
    image = (Path(__file__).parents[2] / "mc_nested/learn/presets/image.toml").read_text("utf-8")
    (tmp_path / "screen.toml").write_text(image.replace('states = "image"', 'states = "screen"'), encoding="utf-8")
    assert run(*words) == 2
    said = capsys.readouterr().err
    assert said.startswith('mc-nested: states "screen" need a game\'s window, and the simulator has none')
    assert said.count("\n") == 1


def test_screen_states_are_refused_for_the_single_agent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.toml").write_text(SMALL)
    assert run(*TRAIN, "--backend", "virtual", "--agent", "single", "--out", "run") == 2
    assert "not for the single agent" in capsys.readouterr().err
    assert not (tmp_path / "run").exists()
