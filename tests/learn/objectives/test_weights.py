"""The weights that come with the package, and broken ones."""

from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import RunError
from mc_nested.learn.objectives import weights
from mc_nested.learn.objectives.weights import agent_of, shipped_file, shipped_weights


def test_weights_are_read_as_they_were_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "own.safetensors"
    file.write_bytes(save({"main": np.arange(3, dtype=np.float32), "nested": np.ones(2, np.float32)}))
    monkeypatch.setattr(weights, "shipped_file", lambda: file)
    assert [each.tolist() for each in shipped_weights()] == [[0.0, 1.0, 2.0], [1.0, 1.0]]


def test_the_shipped_weights_are_of_two_megabytes_at_most() -> None:
    assert shipped_file().stat().st_size <= 2_000_000


@pytest.mark.parametrize("content", [b"", b"nothing of the kind", b"\x08\x00\x00\x00\x00\x00\x00\x00{}      "])
def test_broken_weights_are_refused_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: bytes
) -> None:
    file = tmp_path / "own.safetensors"
    file.write_bytes(content)
    monkeypatch.setattr(weights, "shipped_file", lambda: file)
    with pytest.raises(RunError, match=r"^any-design.safetensors: is broken \(.*\): install the package again$"):
        shipped_weights()


def test_weights_that_are_gone_are_refused_in_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(weights, "shipped_file", lambda: tmp_path / "none")
    with pytest.raises(RunError, match=r"^any-design.safetensors: can't be read .*: install the package again$"):
        shipped_weights()


def test_weights_of_another_version_are_refused_in_one_line() -> None:
    shipped = shipped_weights()
    with pytest.raises(RunError, match=r"of another version .*: install the package again"):
        agent_of(shipped._replace(main=shipped.main[1:]), load_scenario("line"))
