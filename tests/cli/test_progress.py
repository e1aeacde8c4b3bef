"""A training's progress bar: what it says of a training, and no more often than is needed."""

import io

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
    return str(progress._bar.tasks[0].fields["figures"])


def test_it_says_score_optimum_epsilon_and_updates() -> None:
    training = trainer()
    with TrainingProgress(DOT, training) as progress:
        progress.show()
        assert figures(progress) == "mean score     - of 11  ε 1.00 1.00  0 updates/s"
        training.episode_rows += [EpisodeRow(0, 1, 11.0, 1, 4, 1.0, 1.0), EpisodeRow(1, 1, -5.0, 0, 4, 1.0, 1.0)]
        training.episodes_done[:] = [20, 5]
        progress._next = 0.0
        progress.show()
        assert figures(progress).startswith("mean score   3.0 of 11  ")
        assert progress._bar.tasks[0].completed == 25
        assert progress._bar.tasks[0].total == 40


def test_a_finished_run_counts_whole_and_the_bar_is_not_refreshed_too_often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress_module, "REFRESH_S", 1000.0)
    training = trainer()
    with TrainingProgress(DOT, training) as progress:
        progress.show()
        training.episodes_done[:] = [3, 5]
        training.runs_finished[0] = True
        progress.show()
        assert progress._bar.tasks[0].completed == 0
    assert progress._bar.tasks[0].completed == 20 + 5


def imagining(trials: int = 1) -> Trainer:
    preset = load_preset("live").model_copy(update={"hidden": [4, 4]})
    agent = Agent(AGENT_SPECS["nested"], [SMALL] * trials, preset, 0)
    return Trainer(GridVectorEnv([SMALL] * trials), [SMALL] * trials, agent, preset, 0)


def terminal(height: int, *, is_terminal: bool = True) -> Console:
    return Console(file=io.StringIO(), force_terminal=is_terminal, width=120, height=height)


def printed(console: Console) -> str:
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


def test_with_an_imagination_it_says_what_was_found_out_instead_of_epsilon() -> None:
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
    console = terminal(9)
    with TrainingProgress(SMALL, imagining(), console):
        pass
    assert "built elsewhere" in printed(console)


@pytest.mark.parametrize(
    ("trials", "console"), [(2, terminal(40)), (1, terminal(8)), (1, terminal(40, is_terminal=False))]
)
def test_of_several_trials_or_where_there_is_no_room_no_map_is_shown(trials: int, console: Console) -> None:
    with TrainingProgress(SMALL, imagining(trials), console) as progress:
        progress.show()
    assert "built elsewhere" not in printed(console)
    assert ("trial 0: 0 played" in figures(progress)) == (trials > 1)
