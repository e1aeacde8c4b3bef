"""The benchmark of trainings from scratch: its clocks, its comparison with the world, and its wrong counts."""

import dataclasses
from collections.abc import Callable

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.imagination.background_practice import GoesOn
from mc_nested.learn.imagination.experience import RECENT
from mc_nested.learn.preset import load_preset
from scripts.bench import main
from scripts.benches.game_time import (
    PracticeOnAClock,
    TimedTraining,
    medians,
    train,
    wrongly_learnt,
)

LINE = load_scenario("line")
RIGHT = TimedTraining("line", 1, True, 8, 0, 100.0, 15.0, 5.0, 20.0, 0, 300, 0, 0, 0, 0, 0)


class TwoClocks:
    """The game's and the processor's, in seconds; work takes the processor a quarter of a second at a time."""

    def __init__(self) -> None:
        self.game = self.processor = 0.0
        self.practice = PracticeOnAClock(lambda: self.game, lambda: self.processor)

    def work_of(self, seconds: float) -> Callable[[GoesOn], None]:
        def work(goes_on: GoesOn) -> None:
            until = self.processor + seconds
            while self.processor < until and goes_on():
                self.processor += 0.25

        return work


@pytest.mark.parametrize(
    ("takes_s", "reset_s", "done_s", "waited_s", "cut_short"),
    [(1.0, 2.0, 1.0, 0.0, 0), (2.5, 2.0, 2.5, 0.5, 0), (9.0, 2.0, 3.0, 1.0, 1), (9.0, 0.0, 1.0, 1.0, 1)],
)
def test_practice_gets_the_reset_time_and_one_second_and_the_game_waits_for_the_excess(
    takes_s: float, reset_s: float, done_s: float, waited_s: float, cut_short: int
) -> None:
    clocks = TwoClocks()
    clocks.practice.begin(clocks.work_of(takes_s))
    clocks.game += reset_s
    clocks.practice.end(1.0)
    clocks.practice.end(1.0)
    assert (clocks.practice.processor_s, clocks.practice.waited_s) == (done_s, waited_s)
    assert clocks.practice.cut_short == cut_short


@pytest.mark.slow
def test_a_training_without_mishaps_gets_to_the_optimum_and_nothing_is_wrong() -> None:
    trial = train(LINE, 1, load_preset("model-based"), 0.0)
    assert trial.solved
    assert trial.is_right
    assert (trial.spoiled, trial.mishaps) == (0, 0)
    assert 0 < trial.game_s <= 60 * trial.minutes


@pytest.mark.slow
def test_training_with_mishaps_learns_nothing_from_spoiled_episodes() -> None:
    trial = train(LINE, 2, load_preset("model-based"), 0.03)
    assert trial.spoiled > 0
    assert trial.mishaps > 0
    assert trial.is_right


def test_wrongly_learnt_counts_transitions_that_differ_from_the_last_episodes() -> None:
    one, two = (0, 0, 7, 1, 0, 1, 7), (0, 1, 7, 1, 0, 2, 7)
    later: list[list[tuple[int, ...]]] = [[two]] * RECENT
    assert wrongly_learnt([list(one), list(two)], [[one], [two]]) == 0
    assert wrongly_learnt([list(two)], [[one], [two]]) == 2
    assert wrongly_learnt([list(one), list(one)], [[one], [two]]) == 1
    assert wrongly_learnt([list(one), list(two), list(two)], [[one], [two]]) == 1
    assert wrongly_learnt([list(two)] * RECENT, [[one], *later]) == 0


def test_minutes_are_game_time_and_waiting_and_infinite_for_an_unsolved_trial() -> None:
    assert RIGHT.minutes == 2.0
    unsolved = dataclasses.replace(RIGHT, solved=False)
    assert unsolved.minutes == float("inf")
    slow = dataclasses.replace(RIGHT, game_s=220.0)
    assert medians([RIGHT, unsolved, slow]) == {"line": 4.0}


@pytest.mark.parametrize("wrong", ["wrong_cells", "wrong_blocks", "unnoticed", "wrongly_learnt"])
def test_trial_with_a_single_wrong_count_is_not_right(wrong: str) -> None:
    assert RIGHT.is_right
    trial = dataclasses.replace(RIGHT)
    setattr(trial, wrong, 1)
    assert not trial.is_right


@pytest.mark.parametrize(
    ("arguments", "told"), [(["--seeds", "0"], "--seeds must be at least 1"), (["--preset", "paper"], "paper has none")]
)
def test_bad_options_are_refused_in_a_line(arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["game-time", *arguments])
    assert told in capsys.readouterr().err
