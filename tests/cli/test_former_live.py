"""A run of the former preset ``live``, with [excursions]: it still opens, goes on, and can't begin one of the new."""

from pathlib import Path

import pytest
import tomlkit

from mc_nested.learn.runs.run_folder import RunFolder
from tests.cli.running import run, table

CONFIG = Path(__file__).with_name("former_live.toml")
"""The config.toml of a training of 20 episodes, as it was written then."""

IDENTITY = "84dd0e4483ea38bf15ce8125ed6238030f2588caf1d0a0916fc493961dabf18a"
"""What the checkpoint beside it had as its identity."""


@pytest.fixture(scope="module")
def former(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A training by that config.toml, begun again from it alone."""
    folder = tmp_path_factory.mktemp("former")
    (folder / "config.toml").write_bytes(CONFIG.read_bytes())
    assert run("train", "--resume", folder) == 0
    return folder


def test_its_checkpoint_still_fits_its_config(former: Path) -> None:
    assert RunFolder.open(former).checkpoint.identity == IDENTITY


def test_it_goes_on_and_is_evaluated_and_played(former: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(table(former / "episodes.csv")) == 20
    for verb in (("train", "--resume"), ("runs", "evaluate"), ("play",)):
        assert run(*verb, former) == 0
    assert not (former / "map.png").exists()
    capsys.readouterr()


def test_it_begins_another_of_its_own_preset(former: Path, tmp_path: Path) -> None:
    preset = tomlkit.parse(CONFIG.read_text("utf-8"))["preset"]
    (tmp_path / "former.toml").write_text(tomlkit.dumps(preset.unwrap()), "utf-8")
    assert run("train", "--preset", tmp_path / "former.toml", "--from", former, "--out", tmp_path / "on") == 0
    assert table(tmp_path / "on" / "evaluations.csv")[0]["episode"] == "0"


def test_the_new_preset_cannot_begin_from_it_and_says_so_in_one_line(
    former: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "--preset", "live", "--from", former, "--out", tmp_path / "new") == 2
    said = capsys.readouterr().err
    assert said.startswith(f"mc-nested: {former}: its networks don't fit this training: take its agent (nested)")
    assert said.count("\n") == 1
    assert not (tmp_path / "new").exists()
