"""Checkpoints: whole or not at all, and never taken for another run's."""

from pathlib import Path

import numpy as np
import pytest

from mc_nested.errors import RunError
from mc_nested.learn.checkpoint import FILE, part_of, read_checkpoint, write_checkpoint

IDENTITY = {"scenario": "line", "preset": {"batch": 32, "hidden": [32, 32]}}
STATE = {"weights": np.arange(6.0).reshape(2, 3), "ids": np.array([7], np.uint16), "none": np.zeros((0, 7))}


def test_what_was_saved_is_read_back(tmp_path: Path) -> None:
    write_checkpoint(tmp_path / "checkpoint", STATE, IDENTITY)
    found = read_checkpoint(tmp_path / "checkpoint", {**IDENTITY})
    assert found.keys() == STATE.keys()
    for name, kept in STATE.items():
        np.testing.assert_array_equal(found[name], kept)
        assert found[name].dtype == kept.dtype


def test_the_same_state_is_the_same_file(tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_checkpoint(tmp_path / name, STATE, IDENTITY)
    assert (tmp_path / "one" / FILE).read_bytes() == (tmp_path / "two" / FILE).read_bytes()


def test_a_write_that_breaks_off_leaves_the_last_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_checkpoint(tmp_path, STATE, IDENTITY)

    def full_disk(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        write_checkpoint(tmp_path, {"weights": np.zeros(1)}, IDENTITY)
    assert np.array_equal(read_checkpoint(tmp_path, IDENTITY)["weights"], STATE["weights"])


@pytest.mark.parametrize("kept", [0, 1, 100, 1000, -1])
def test_a_truncated_checkpoint_is_one_clear_line(tmp_path: Path, kept: int) -> None:
    write_checkpoint(tmp_path, STATE, IDENTITY)
    whole = (tmp_path / FILE).read_bytes()
    (tmp_path / FILE).write_bytes(whole[:kept])
    with pytest.raises(RunError, match="damaged or cut short: bring back a whole copy") as caught:
        read_checkpoint(tmp_path, IDENTITY)
    assert "\n" not in str(caught.value)


def test_a_checkpoint_of_another_scenario_is_refused(tmp_path: Path) -> None:
    write_checkpoint(tmp_path, STATE, IDENTITY)
    with pytest.raises(RunError, match="belongs to another scenario, agent or preset"):
        read_checkpoint(tmp_path, {**IDENTITY, "scenario": "diamond"})


def test_no_checkpoint_is_one_clear_line(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="no checkpoint yet"):
        read_checkpoint(tmp_path, IDENTITY)


def test_a_part_of_a_state_has_the_parts_own_names() -> None:
    state = {"main.x": np.array([1]), "nested.main.x": np.array([2]), "maintain": np.array([3])}
    assert part_of(state, "main") == {"x": np.array([1])}
