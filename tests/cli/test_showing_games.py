"""A learner with several games is shown as any other training is."""

import io
from pathlib import Path

from rich.console import Console

from mc_nested.arena.action import Cell
from mc_nested.cli.progress import TrainingProgress
from mc_nested.cli.training_view import TrainingView
from mc_nested.report.tensorboard import FILE, TensorBoard
from mc_nested.view.board import Board
from tests.learn.games.lockstep import finish, game_of, learner_of
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_experiments import run_config


class OneArena:
    """The arena of a game that plays elsewhere, as a view sees it."""

    def cell(self, run: int) -> Cell:  # noqa: ARG002 - there is one
        return BENT.start

    def placed(self, run: int) -> frozenset[Cell]:  # noqa: ARG002 - there is one
        return frozenset()


def test_learner_with_games_shows_progress_view_and_events_as_one_trial(tmp_path: Path) -> None:
    learner = learner_of(BENT, SMALL)
    config = run_config(BENT, preset=SMALL)
    board, said = Board("train", "a title"), io.StringIO()
    console = Console(file=said, width=120)
    view, events = TrainingView(board, learner, BENT, OneArena(), config), TensorBoard([tmp_path], learner)
    with TrainingProgress(BENT, learner, console) as progress:
        finish(learner, game_of(BENT, SMALL))
        progress.show()
        view.show_end()
        events.write()
    learning = board.status().learning
    assert learning is not None
    assert (learning.episodes, learning.best, learning.at_optimum) == (SMALL.episodes, BENT.optimum, 1)
    assert "3 of 3 cells known" in learning.exploring
    assert f"episodes {SMALL.episodes} of at most {SMALL.episodes}" in said.getvalue()
    assert (tmp_path / FILE).stat().st_size > 0
