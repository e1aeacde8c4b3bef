"""The command: where Wine can't be had it is one line and exit code 2."""

import os
import sys
from pathlib import Path

import pytest

from scripts import windows
from scripts.standin_parts import Program


def test_another_system_is_one_line_and_exit_code_2(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.platform", "darwin")
    assert windows.main(["setup"], tmp_path / "cache") == 2
    said = capsys.readouterr().err
    assert said.startswith("windows: Wine needs Linux")
    assert said.count("\n") == 1
    assert not (tmp_path / "cache").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="Linux without apt")
def test_without_apt_it_is_one_line_that_names_the_packages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", os.fspath(tmp_path))
    monkeypatch.setattr("scripts.windows_parts.WINE", windows_program("no-such-wine"))
    assert windows.main(["setup"], tmp_path / "cache") == 2
    said = capsys.readouterr().err
    assert said.startswith("windows: Wine needs programs that it can only get with apt")
    assert "no-such-wine" in said
    assert said.count("\n") == 1


def windows_program(name: str) -> Program:
    return Program((name,), name)
