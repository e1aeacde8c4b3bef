"""The kept policies beside a checkpoint: the same to the bit, read without torch, and never another save's."""

from pathlib import Path

import numpy as np
import pytest

from mc_nested.errors import RunError
from mc_nested.learn.runs.checkpoint import Checkpoint
from mc_nested.learn.runs.policies import FILE, load_policies, save_policies
from tests.learn.runs.test_checkpoint import IDENTITY, Counts

KEPT = {"main": np.linspace(-1, 1, 12, dtype=np.float32).reshape(2, 6), "scores": np.array([1.5, -np.inf])}
SHAPES = {name: array.shape for name, array in KEPT.items()}


@pytest.fixture
def saved(tmp_path: Path) -> Checkpoint:
    checkpoint = Checkpoint(tmp_path, IDENTITY)
    checkpoint.save(Counts().count(2))
    save_policies(checkpoint, KEPT)
    return checkpoint


def test_what_was_saved_is_read_back_to_the_bit(saved: Checkpoint) -> None:
    found = load_policies(saved, SHAPES)
    assert found is not None
    assert {name: (array.dtype, array.shape, array.tobytes()) for name, array in found.items()} == {
        name: (array.dtype, array.shape, array.tobytes()) for name, array in KEPT.items()
    }


def test_the_same_policies_are_the_same_file(saved: Checkpoint) -> None:
    before = saved.file.with_name(FILE).read_bytes()
    save_policies(saved, {name: array.copy() for name, array in KEPT.items()})
    assert saved.file.with_name(FILE).read_bytes() == before


def test_policies_of_an_earlier_save_do_not_count(saved: Checkpoint) -> None:
    saved.save(Counts().count(3))
    assert load_policies(saved, SHAPES) is None


def test_without_the_file_or_with_a_part_of_it_there_are_none(saved: Checkpoint) -> None:
    file = saved.file.with_name(FILE)
    whole = file.read_bytes()
    for kept in (0, 1, 100, len(whole) - 1):
        file.write_bytes(whole[:kept])
        assert load_policies(saved, SHAPES) is None
    with file.open("wb") as one_array:
        np.save(one_array, KEPT["main"])
    assert load_policies(saved, SHAPES) is None
    # One flipped bit of the archive's directory: an entry with a password.
    entry = whole.index(b"PK\x01\x02")
    file.write_bytes(whole[: entry + 8] + bytes([whole[entry + 8] | 1]) + whole[entry + 9 :])
    assert load_policies(saved, SHAPES) is None
    file.unlink()
    assert load_policies(saved, SHAPES) is None


def test_policies_of_another_training_are_refused_in_one_line(saved: Checkpoint) -> None:
    other = Checkpoint(saved.file.parent, {**IDENTITY, "scenario": "diamond"})
    with pytest.raises(RunError, match="belongs to another scenario, agent or preset") as caught:
        load_policies(other, SHAPES)
    assert "\n" not in str(caught.value)
