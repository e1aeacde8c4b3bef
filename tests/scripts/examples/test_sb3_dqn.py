"""The example of stable-baselines3: it runs as it is, it learns, and a mistake is one line."""

import sys
from pathlib import Path

import pytest

from scripts.examples.sb3_dqn import main
from tests.scripts.examples.running import MISTAKES, PAIR, pair_in, run


def test_example_without_stable_baselines3_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)  # importing it fails
    assert main([]) == 2
    assert capsys.readouterr().err == (
        "sb3_dqn: stable-baselines3 isn't installed: pip install -c constraints.txt -e '.[bench]'\n"
    )


@pytest.mark.slow
def test_a_few_hundred_steps_end_with_a_greedy_episode(tmp_path: Path) -> None:
    done = run("sb3_dqn", tmp_path, "--scenario", "line", "--steps", "600", "--seed", "3")
    assert (done.returncode, done.stderr) == (0, "")
    last = done.stdout.splitlines()[-1]
    assert last.startswith("greedy: score ")
    assert last.endswith(" of 21")
    assert done.stdout == run("sb3_dqn", tmp_path, "--scenario", "line", "--steps", "600", "--seed", "3").stdout


@pytest.mark.slow
def test_the_example_learns_two_blocks_within_seconds(tmp_path: Path) -> None:
    done = run("sb3_dqn", tmp_path, "--scenario", pair_in(tmp_path), "--steps", "3000")
    assert done.stdout.splitlines()[-1] == f"greedy: score {PAIR.optimum:g} of {PAIR.optimum:g}"
    assert "ep_rew_mean" in done.stdout  # the library's own table of what the episodes return


@pytest.mark.slow
@MISTAKES
def test_mistake_is_refused_in_one_line_with_exit_code_2(words: list[str], says: str, tmp_path: Path) -> None:
    done = run("sb3_dqn", tmp_path, *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("sb3_dqn: ")
    assert says in done.stderr
    assert done.stderr.count("\n") == 1
