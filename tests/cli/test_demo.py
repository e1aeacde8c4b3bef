"""The demo trains in a new folder, and plays what it has trained."""

from pathlib import Path

import pytest

from mc_nested.cli import demo
from tests.cli.running import run


def test_demo_trains_on_the_line_and_shows_what_was_built(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(demo, "MOST_EPISODES", 2)
    assert run("demo") == 0
    (folder,) = (tmp_path / "runs").iterdir()
    assert folder.name.startswith("demo-")
    assert (folder / "curve.png").exists()
    printed = capsys.readouterr().out
    assert (
        printed.index("Training the nested agent") < printed.index("curve.png") < printed.index("the agent   #  built")
    )
    assert "of 21, in" in printed
