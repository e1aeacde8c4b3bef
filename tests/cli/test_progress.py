"""A training's progress bar: its figures, its map, and how often it is refreshed."""

import io
import os
import re

import pytest
from rich.console import Console

from mc_nested.cli import progress as progress_module
from mc_nested.cli.progress import TrainingProgress
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.cli.made_imagination import SMALL
from tests.learn.made_experiments import DOT, small_preset


def trainer() -> Trainer:
    preset = small_preset()
    return Trainer(GridVectorEnv([DOT] * 2), [DOT] * 2, Agent(AGENT_SPECS["nested"], [DOT] * 2, preset, 0), preset, 0)


def figures(progress: TrainingProgress) -> str:
    return progress._bar.figures


def test_progress_shows_score_optimum_epsilon_and_updates() -> None:
    training = trainer()
    with TrainingProgress(DOT, training, terminal(40)) as progress:
        progress.show()
        assert figures(progress) == "mean score     - of 11  ε 1.00 1.00  0 updates/s"
        training.episode_rows += [EpisodeRow(0, 1, 11.0, 1, 4, 1.0, 1.0), EpisodeRow(1, 1, -5.0, 0, 4, 1.0, 1.0)]
        training.episodes_done[:] = [20, 5]
        progress._next = 0.0
        progress.show()
        assert figures(progress).startswith("mean score   3.0 of 11  ")
        assert progress._bar.tasks[0].completed == 25
        assert progress._bar.tasks[0].total == 40


def test_finished_trial_counts_as_complete_and_the_bar_is_not_refreshed_too_often(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(progress_module, "REFRESH_S", 1000.0)
    training = trainer()
    with TrainingProgress(DOT, training, terminal(40)) as progress:
        progress.show()
        training.episodes_done[:] = [3, 5]
        training.runs_finished[0] = True
        progress.show()
        assert progress._bar.tasks[0].completed == 0
    assert progress._bar.tasks[0].completed == 3 + 5
    assert progress._bar.tasks[0].total == 3 + 20


def imagining(trials: int = 1) -> Trainer:
    preset = load_preset("model-based").model_copy(update={"hidden": [4, 4]})
    agent = Agent(AGENT_SPECS["nested"], [SMALL] * trials, preset, 0)
    return Trainer(GridVectorEnv([SMALL] * trials), [SMALL] * trials, agent, preset, 0)


def terminal(height: int, *, is_terminal: bool = True) -> Console:
    return Console(file=io.StringIO(), force_terminal=is_terminal, width=120, height=height)


def printed(console: Console) -> str:
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_progress_of_an_imagining_agent_shows_known_cells_instead_of_epsilon() -> None:
    training = imagining()
    with TrainingProgress(SMALL, training, terminal(40)) as progress:
        progress.show()
        assert "  0 played, probing, 0 of 2 cells known  " in figures(progress)
        assert "ε" not in figures(progress)
        training.tick()
        progress._next = 0.0
        progress.show()
        assert "  1 played, probing, " in figures(progress), "a new episode is seen at once"


def test_a_terminal_shows_the_map_of_a_single_trial_below_the_bar() -> None:
    console = terminal(13)
    with TrainingProgress(SMALL, imagining(), console):
        pass
    assert "built elsewhere" in printed(console)


@pytest.mark.parametrize(
    ("trials", "console"), [(2, terminal(40)), (1, terminal(12)), (1, terminal(40, is_terminal=False))]
)
def test_no_map_is_shown_for_several_trials_in_a_low_terminal_or_without_one(trials: int, console: Console) -> None:
    with TrainingProgress(SMALL, imagining(trials), console) as progress:
        progress.show()
    assert "built elsewhere" not in printed(console)
    assert ("trial 0: 0 played" in figures(progress)) == (trials > 1)


def test_without_a_terminal_progress_is_a_whole_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress_module, "LINE_EVERY_S", 1000.0)
    console = Console(file=io.StringIO(), width=40)
    training = imagining()
    with TrainingProgress(SMALL, training, console) as progress:
        progress.show()
        assert printed(console) == ""
        progress._next = 0.0
        progress.show()
        progress.show()
        line = "episodes 0 of at most 200  mean score     - of 12  0 played, probing, 0 of 2 cells known  0 updates/s\n"
        assert printed(console) == line
        training.episodes_done[:], training.runs_finished[:] = 3, True
    assert printed(console).removeprefix(line).startswith("episodes 3 of at most 3  ")
    assert printed(console).count("\n") == 2


def test_terminal_says_that_the_training_is_stopping_during_its_last_tick() -> None:
    stops, console = [False], terminal(40)
    with TrainingProgress(SMALL, imagining(), console, lambda: stops[0]) as progress:
        progress._bar.refresh()
        assert "stopping" not in printed(console)
        stops[0] = True
        progress._bar.refresh()
        assert "stopping: what is under way ends, then it is saved" in printed(console)


@pytest.mark.parametrize("trials", [1, 2])
def test_in_a_narrow_terminal_nothing_is_cut(trials: int) -> None:
    console = Console(file=io.StringIO(), force_terminal=True, width=60, height=40)
    with TrainingProgress(SMALL, imagining(trials), console) as progress:
        progress.show()
    shown = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", printed(console))
    assert "episodes ━" in shown
    assert f" 0/{200 * trials} " in shown
    assert " updates/s" in shown
    assert "…" not in shown


def test_map_is_drawn_again_at_the_end() -> None:
    training, console = imagining(), terminal(40)
    with TrainingProgress(SMALL, training, console) as progress:
        progress.show()
        for _ in range(SMALL.step_limit):
            training.tick()
        assert training.practice.imagination
        progress._looked_at, progress._look_again = training.practice.imagination.episodes(0), float("inf")
        shown = progress._bar.map
    assert progress._bar.map is not shown


def test_closed_pipe_does_not_end_the_training() -> None:
    reads, writes = os.pipe()
    os.close(reads)
    gone = os.fdopen(writes, "w")
    with TrainingProgress(SMALL, imagining(), Console(file=gone, width=80)) as progress:
        progress._next = 0.0
        progress.show()
    with pytest.raises(BrokenPipeError):
        gone.close()
