"""What each variant does beside its own agent's base."""

from pathlib import Path

import pytest

from mc_nested.report.inference import Interval
from mc_nested.report.sweep_results import effects_on, write_rows
from tests.report.made_sweep import made_sweep


def test_a_variant_stands_beside_the_base_of_its_own_agent() -> None:
    effects = {(effect.agent, effect.choice): effect for effect in effects_on(made_sweep(), "line")}
    assert list(effects) == [("nested", ""), ("single", ""), ("nested", "γ"), ("nested", "rate"), ("single", "state")]
    worse, better = effects["nested", "γ"], effects["single", "state"]
    assert worse.final_difference == pytest.approx(15 - 62 / 3)
    assert worse.mean_difference == pytest.approx(13 - 56 / 3)
    assert (better.final_difference, better.final_interval) == (2.0, Interval(2.0, 2.0))
    assert worse.final_interval
    # Of 20, 21, 21 the error is 1 / 3; t with two degrees of freedom is 4.3027 at 0.975.
    assert worse.final_interval.low == pytest.approx(15 - 62 / 3 - 4.3027 / 3, abs=1e-4)
    assert worse.final_interval.high < 0


def test_a_base_has_no_effect_and_no_interval() -> None:
    base = effects_on(made_sweep(), "line")[0]
    assert (base.final_difference, base.mean_difference) == (0.0, 0.0)
    assert base.final_interval is base.mean_interval is None


def test_the_same_in_another_order_is_no_clear_effect() -> None:
    interval = next(effect for effect in effects_on(made_sweep(), "line") if effect.choice == "rate").final_interval
    assert interval
    assert interval.low < 0 < interval.high


def test_a_single_trial_has_no_interval() -> None:
    sweep = made_sweep()
    alone = [row for row in sweep.rows if row.trial == 0]
    assert all(
        effect.final_interval is None for effect in effects_on(type(sweep)(**{**vars(sweep), "rows": alone}), "line")
    )


def test_a_row_for_each_trial(tmp_path: Path) -> None:
    write_rows(tmp_path / "sweep.csv", made_sweep().rows)
    lines = (tmp_path / "sweep.csv").read_text("utf-8").splitlines()
    header = "agent,choice,value,scenario,trial,final_score,best_score,mean_score,episodes_to_optimum"
    assert lines[:3] == [header, "nested,,,line,0,20,21,18,", "nested,,,line,1,21,22,19,60"]
    assert len(lines) == 1 + 2 * 5 * 3
