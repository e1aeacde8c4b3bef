"""The status that a training shows in the view: its curve, its arena and its progress."""

import numpy as np
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli.training_view import ScoreCurve, TrainingView
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.report.game_time import expected
from mc_nested.view.board import Board
from mc_nested.view.status import MOST_SCORES, Learning
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import run_config

LINE = load_scenario("line")


def rows(*scores: float, trial: int = 0) -> list[EpisodeRow]:
    return [EpisodeRow(trial, number, score, 0, 30, 0.1, 0.1) for number, score in enumerate(scores, 1)]


def test_the_curve_is_the_mean_of_the_trials_episode_by_episode() -> None:
    curve = ScoreCurve()

    assert curve.after([]) == ()
    assert curve.after([*rows(1, 2, 3), *rows(3, 6, trial=1)]) == (2, 4, 3)


def test_the_curve_takes_each_row_once() -> None:
    curve, first = ScoreCurve(), rows(1, 2)
    curve.after(first)

    assert curve.after([*first, *rows(3, 4, trial=1)]) == (2, 3)


def test_long_curve_is_reduced_to_the_largest_number_of_points() -> None:
    curve = ScoreCurve()

    points = curve.after(rows(*np.linspace(0, 20, 3000)))

    assert len(points) == MOST_SCORES
    assert points[0] < 0.2
    assert points[-1] > 19.8


def a_training(preset_name: str, trials: int, backend: str = "sim") -> tuple[Trainer, TrainingView, Board]:
    preset = load_preset(preset_name)
    scenarios = [LINE] * trials
    env = GridVectorEnv(scenarios)
    agent = Agent(AGENT_SPECS["nested"], scenarios, preset, 0)
    trainer = Trainer(agent.view_of(env, scenarios), scenarios, agent, preset, 0)
    config = run_config(LINE, backend=backend, trials=trials, preset_name=preset_name, preset=preset)
    board = Board("train", "a title")
    return trainer, TrainingView(board, trainer, LINE, env, config), board


def shown_learning(board: Board) -> Learning:
    learning = board.status().learning
    assert learning is not None
    return learning


def test_before_the_first_tick_the_arena_is_empty() -> None:
    _, view, board = a_training("paper", 2)
    view.show()

    status = board.status()

    assert status.arena is not None
    assert status.arena.stands == ()
    assert [tuple(agents) for agents in status.arena.agents] == [(*LINE.start, 2)]
    assert shown_learning(board) == Learning(
        trials=2, episodes_at_most=6000, optimum=21.0, exploring="ε 1.00, 1.00 (main agent, nested agent)"
    )


def test_view_counts_the_agents_and_blocks_of_all_trials_in_each_cell() -> None:
    trainer, view, board = a_training("paper", 5)
    for _ in range(200):
        trainer.tick()
    view.show_end()

    arena = board.status().arena

    assert arena is not None
    assert sum(agents.trials for agents in arena.agents) == 5
    assert all(1 <= standing.trials <= 5 for standing in arena.stands)
    assert shown_learning(board).episodes == int(trainer.episodes_done.sum())


def test_view_shows_the_beliefs_of_a_single_trial() -> None:
    trainer, view, board = a_training("model-based", 1)
    for _ in range(60):
        trainer.tick()
    view.show_end()

    arena = board.status().arena
    assert arena is not None
    assert len(arena.beliefs) == LINE.size
    assert {sign for row in arena.beliefs for sign in row} <= set(".?o-")
    assert "of 11 cells known" in shown_learning(board).exploring


def test_game_time_left_is_shown_only_for_a_live_training() -> None:
    _, simulated, board = a_training("model-based", 1)
    simulated.show()
    assert shown_learning(board).game_minutes_left is None

    trainer, live, board = a_training("model-based", 1, "live")
    live.show()
    whole = expected(trainer.preset, LINE, stop_at_optimum=False)
    assert shown_learning(board).game_minutes_left == pytest.approx(whole.minutes)

    while not trainer.episode_rows:
        trainer.tick()
    live.show_end()
    played = len(trainer.episode_rows) + len(trainer.evaluation_rows)
    assert shown_learning(board).game_minutes_left == pytest.approx(whole.minutes * (1 - played / whole.episodes))


def test_the_best_score_never_falls() -> None:
    trainer, view, board = a_training("paper", 3)
    best = -1.0
    for _ in range(40):
        for _ in range(25):
            trainer.tick()
        view.show_end()
        learning = shown_learning(board)
        if learning.best is not None:
            assert learning.best >= best
            best = learning.best
    highest = [-np.inf] * 3
    for trial, _, score, *_ in (*trainer.episode_rows, *trainer.evaluation_rows):
        highest[int(trial)] = max(highest[int(trial)], score)
    assert best == pytest.approx(np.mean(highest))
