"""``mc-nested study sweep``, tiny."""

import json
from pathlib import Path

import pytest

from mc_nested.cli.output import json_fields
from mc_nested.cli.study import command_of, declared
from tests.cli.running import check_one_at_a_time, run, table, write_study
from tests.learn.made_experiments import DOT


@pytest.mark.slow
def test_a_sweep_leaves_a_row_for_each_trial_a_table_and_a_plot(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["study", "sweep", *write_study(tmp_path, DOT)]
    found = []
    for jobs in ("1", "2"):
        out = tmp_path / jobs
        assert run(*words, "--episodes", "10", "--jobs", jobs, "--out", out) == 0
        found.append({name: (out / name).read_bytes() for name in ("sweep.csv", "sweep.md", "sweep.png")})
        before = found[-1]
        assert run("study", "sweep", "--resume", out) == 0
        assert {name: (out / name).read_bytes() for name in before} == before
    assert found[0] == found[1]
    capsys.readouterr()
    assert run("study", "sweep", "--resume", out, "--json") == 0
    files = {"table": str(out / "sweep.md"), "plot": str(out / "sweep.png"), "rows": str(out / "sweep.csv")}
    assert set(json_fields(command_of(declared("sweep")))) == {"folder", "files"}
    assert json.loads(capsys.readouterr().out) == {"folder": str(out), "files": files}
    check_one_at_a_time(["study", "sweep"], out, capsys)
    rows = table(out / "sweep.csv")
    base = [row for row in rows if (row["agent"], row["choice"]) == ("nested", "")]
    assert [(row["scenario"], row["trial"]) for row in base] == [("dot", "0"), ("dot", "1")]
    assert len(rows) % 2 == 0
    assert ("γ", "0.99") in {(row["choice"], row["value"]) for row in rows}
    for row in rows:
        assert float(row["mean_score"]) <= float(row["best_score"]) <= DOT.optimum
