"""A made-up sensitivity run: two scenarios, a base of each agent, and what is otherwise."""

from mc_nested.report.sweep_results import Sweep, SweepRow


def rows(agent: str, choice: str, value: str, scenario: str, finals: list[float]) -> list[SweepRow]:
    """Trials with those final scores, one block better at best, two worse in the mean; at 21 after 60 episodes."""
    return [
        SweepRow(agent, choice, value, scenario, trial, final, final + 1, final - 2, 60 if final == 21 else None)
        for trial, final in enumerate(finals)
    ]


def made_sweep() -> Sweep:
    made: list[SweepRow] = []
    for scenario in ("line", "zig|zag"):
        made += rows("nested", "", "", scenario, [20, 21, 21])
        made += rows("single", "", "", scenario, [10, 10, 10])
        made += rows("nested", "γ", "0.5", scenario, [15, 15, 15])
        made += rows("nested", "rate", "1e-3", scenario, [21, 20, 21])
        made += rows("single", "state", "blind", scenario, [12, 12, 12])
    return Sweep("paper", 90, 3, 0, {"line": 21.0, "zig|zag": 21.0}, made)
