"""What playing took, as plain numbers."""

from mc_nested.live.action_log import ActionLog, percentile
from mc_nested.live.motion.effort import Effort


def test_percentiles_are_values_that_shares_lie_below() -> None:
    assert percentile([float(value) for value in range(101)], 50) == 50.0
    assert percentile([float(value) for value in range(101)], 95) == 95.0
    assert percentile([0.25], 95) == 0.25
    assert percentile([0.25, 0.75], 50) == 0.5
    assert percentile([], 50) is None


def test_the_summary_counts_what_the_body_did() -> None:
    log = ActionLog(Effort(moves=4, corrections=1, clicks=2, second_clicks=1), [0.3, 0.3, 0.5], failed_actions=1)
    assert log.summary() == {
        "actions": 3,
        "action_s": {"p50": 0.3, "p95": 0.48, "p99": 0.496},
        "moves": 4,
        "corrections": 1,
        "clicks": 2,
        "second_clicks": 1,
        "failed_actions": 1,
        "failed_resets": 0,
        "recoveries": 0,
    }
