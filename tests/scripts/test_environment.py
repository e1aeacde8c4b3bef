"""The scripts refuse a Python that the packages have no wheels for, in one line, before anything is made."""

import sys
from pathlib import Path

import pytest

from scripts import environment


@pytest.mark.parametrize(
    ("version", "says"),
    [((3, 9, 18), "is too old: run this with Python 3.10 to 3.14"), ((3, 15, 0), "is too new for numba and torch")],
)
def test_python_too_old_or_too_new_is_refused(
    version: tuple[int, int, int], says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(environment, "ENVIRONMENT", tmp_path / "venv")
    monkeypatch.setattr(sys, "version_info", version)
    with pytest.raises(SystemExit, match=says):
        environment.main_python()
    assert not (tmp_path / "venv").exists()
