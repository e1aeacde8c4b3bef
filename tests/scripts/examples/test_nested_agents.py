"""The notebook for students: its cells run in order, as they are."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).parents[3] / "scripts" / "examples" / "nested_agents.ipynb"


def cells(kind: str) -> list[str]:
    """Return the text of each cell of that kind."""
    return ["".join(cell["source"]) for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == kind]


def test_the_notebook_is_committed_without_outputs() -> None:
    code = [cell for cell in json.loads(NOTEBOOK.read_text())["cells"] if cell["cell_type"] == "code"]
    assert code
    assert not any(cell["outputs"] or cell["execution_count"] for cell in code)


@pytest.mark.slow
def test_the_notebook_ends_with_a_verdict_on_each_pair_of_agents(tmp_path: Path) -> None:
    script = tmp_path / "cells.py"
    script.write_text("\n".join(cells("code")))
    environment = {**os.environ, "MPLBACKEND": "agg", "PYTHONPATH": str(NOTEBOOK.parent), "OMP_NUM_THREADS": "1"}
    done = subprocess.run(
        [sys.executable, script],
        check=False,
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=180,
    )
    assert done.returncode == 0, done.stderr
    assert re.search(r"^double: +5\.75$", done.stdout, re.MULTILINE)  # 1 + 0.95 * 5, by hand
    verdicts = re.findall(r"^(\w+) - (\w+): [+-]\d+\.\d\d ± \d+\.\d\d: .*(ahead)", done.stdout, re.MULTILINE)
    assert [pair[:2] for pair in verdicts] == [
        ("nested", "single"),
        ("hierarchical", "single"),
        ("nested", "hierarchical"),
    ]
