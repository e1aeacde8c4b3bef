"""How far an experiment is, from what its processes report."""

from mc_nested.cli.standing import Standing
from mc_nested.cli.unit_process import Ended, Report
from mc_nested.learn.unit_training import Evaluated, RunOutcome, UnitOutcome
from mc_nested.learn.units import Unit, cut_into_units
from tests.learn.experiments import BAR, DOT, runs_of, small_preset


def two_units() -> list[Unit]:
    """Of two trials on the dot and on the bar each, 20 episodes a run: nested in the first, single in the second."""
    return cut_into_units(runs_of(["nested", "single"], [DOT, BAR], 2, small_preset(20)), 1, seed=0)


def outcome(score: float) -> UnitOutcome:
    last = Evaluated(episode=20, score=score, material="stone", steps=3)
    run = RunOutcome(evaluations=[last], score=score, updates=1, env_steps=1)
    return UnitOutcome(identity="", networks=1, parameters=1, seconds=1, runs=[run] * 4)


def test_at_first_nothing_is_done() -> None:
    standing = Standing([(unit, None) for unit in two_units()])
    assert (standing.episodes, standing.total, standing.updates) == (0, 160, 0)
    assert standing.optimum == {"dot": 11.0, "bar": 13.0}
    assert standing.score("nested", "dot") is None


def test_reports_add_up() -> None:
    nested, single = two_units()
    standing = Standing([(nested, None), (single, None)])
    standing.hear(Report(nested.name, [5, 6, 7, 8], (11.0, 10.0, None, 12.0), updates=100))
    standing.hear(Report(nested.name, [6, 6, 7, 8], (11.0, 10.0, None, 12.0), updates=150))
    standing.hear(Report(single.name, [1, 1, 1, 1], (None, None, None, None), updates=40))
    assert standing.episodes == 27 + 4
    assert standing.score("nested", "dot") == 10.5
    assert standing.score("nested", "bar") == 12.0
    assert standing.score("single", "bar") is None
    assert standing.groups == ["nested", "single"]
    standing.hear(Ended(nested.name, finished=True))
    assert standing.episodes == 80 + 4


def test_what_was_done_before_counts_as_done_and_not_as_speed() -> None:
    nested, single = two_units()
    standing = Standing([(nested, outcome(9.0)), (single, None)])
    assert standing.episodes == 80
    assert standing.score("nested", "bar") == 9.0
    standing.hear(Report(single.name, [10, 10, 10, 10], (None, None, None, None), updates=5000))
    assert (standing.episodes, standing.episodes_before, standing.updates) == (120, 120, 0)
    standing.hear(Report(single.name, [11, 11, 11, 11], (None, None, None, None), updates=5300))
    assert (standing.episodes, standing.episodes_before, standing.updates) == (124, 120, 300)
