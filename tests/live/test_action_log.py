"""The action log's counts and percentiles, and the limit on failed episodes.

Failed episodes: counted, accepted up to a limit, but never after a person stopped the game.
"""

import pytest

from mc_nested.errors import NotConfirmedError, StoppedError
from mc_nested.live.action_log import MOST_IN_A_ROW, PROGRESS, ActionLog, Effort, FailureBudget, percentile


def test_percentiles_are_interpolated_and_none_without_values() -> None:
    assert percentile([float(value) for value in range(101)], 50) == 50.0
    assert percentile([float(value) for value in range(101)], 95) == 95.0
    assert percentile([0.25], 95) == 0.25
    assert percentile([0.25, 0.75], 50) == 0.5
    assert percentile([], 50) is None


def test_the_summary_has_the_bodys_counts_and_the_actions_times() -> None:
    log = ActionLog(Effort(moves=4, corrections=1, clicks=2, second_clicks=1), [0.3, 0.3, 0.5], failed_actions=1)
    assert log.summary() == {
        "actions": 3,
        "action_s": {"p50": 0.3, "p95": 0.48, "p99": 0.496},
        "share": "",
        "overlapped": 0,
        "moves": 4,
        "corrections": 1,
        "clicks": 2,
        "second_clicks": 1,
        "failed_actions": 1,
        "failed_resets": 0,
        "recoveries": 0,
    }


ERROR = NotConfirmedError("the agent looks away")


def test_failed_episodes_are_counted_and_the_last_three_messages_kept() -> None:
    failure_budget = FailureBudget()
    for steps in range(4):
        failure_budget.record_failure(NotConfirmedError(f"problem {steps}"), steps)
    assert failure_budget.summary() == {"spoiled_episodes": 4, "last_problems": ["problem 1", "problem 2", "problem 3"]}


def test_too_many_failures_in_a_row_are_an_error() -> None:
    failure_budget = FailureBudget()
    for _ in range(MOST_IN_A_ROW):
        failure_budget.record_failure(ERROR, 3)
    with pytest.raises(NotConfirmedError, match="looks away"):
        failure_budget.record_failure(ERROR, 3)


def test_failures_with_progress_between_them_do_not_end_the_training() -> None:
    failure_budget = FailureBudget()
    for episode in range(10 * MOST_IN_A_ROW):
        failure_budget.record_failure(ERROR, episode * PROGRESS)


def test_a_stopped_game_ends_the_training_at_the_first_failure() -> None:
    with pytest.raises(StoppedError):
        FailureBudget().record_failure(StoppedError("the panic key was pressed"), 0)


def test_progress_since_the_last_failure_restarts_the_count_of_failures_at_one() -> None:
    failure_budget = FailureBudget()
    steps = 0
    for _ in range(MOST_IN_A_ROW):
        failure_budget.record_failure(ERROR, steps := steps + PROGRESS - 1)
    failure_budget.record_failure(ERROR, steps := steps + PROGRESS)
    for _ in range(MOST_IN_A_ROW - 1):
        failure_budget.record_failure(ERROR, steps := steps + PROGRESS - 1)
    with pytest.raises(NotConfirmedError, match="looks away"):
        failure_budget.record_failure(ERROR, steps)


def test_the_time_of_actions_is_walking_confirming_or_deciding() -> None:
    """Two actions of 0.4 and 0.2 s, keys down for 0.3 and 0.2 of them, 0.1 s between them, and a reset after."""
    log = ActionLog(Effort())
    assert str(log.spent) == ""
    log.begins(10.0, 1.0)
    log.ends(10.4, 1.3)
    log.begins(10.5, 1.3)
    log.ends(10.7, 1.5)
    log.pauses()
    log.begins(20.0, 1.5)
    assert vars(log.spent) == pytest.approx({"walking": 0.5, "confirming": 0.1, "deciding": 0.1})
    assert str(log.spent) == "walking 71 %, confirming 14 %, deciding 14 %"
