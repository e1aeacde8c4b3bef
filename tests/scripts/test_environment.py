"""The scripts refuse a Python that the packages have no wheels for, in one line, before anything is made."""

import ast
import sys
from pathlib import Path

import pytest

from scripts import environment


@pytest.mark.parametrize(
    ("version", "says"),
    [((3, 9, 18), "is too old: run this with Python 3.10 to 3.14"), ((3, 15, 0), "is too new for numba and torch")],
)
def test_python_too_old_or_too_new_is_refused(
    version: tuple[int, int, int],
    says: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(environment, "ENVIRONMENT", tmp_path / "venv")
    monkeypatch.setattr(sys, "version_info", version)
    with pytest.raises(SystemExit, match="2"):
        environment.main_python()
    said = capsys.readouterr().err
    assert (says in said, said.count("\n")) == (True, 1)
    assert not (tmp_path / "venv").exists()


@pytest.mark.parametrize("name", ["demo.py", "test.py", "environment.py"])
def test_older_python_can_read_what_refuses_it(name: str) -> None:
    text = (environment.ROOT / "scripts" / name).read_text("utf-8")
    tree = ast.parse(text, feature_version=(3, 7))
    evaluates = any(isinstance(each, ast.arg | ast.AnnAssign) and each.annotation for each in ast.walk(tree))
    assert not evaluates or "from __future__ import annotations" in text
