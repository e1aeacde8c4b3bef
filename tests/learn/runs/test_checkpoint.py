"""Checkpoints: whole or not at all, with additions in journals, and never taken for another run's."""

import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.errors import RunError
from mc_nested.learn.runs import checkpoint as checkpoint_module
from mc_nested.learn.runs.checkpoint import ABOUT, FILE, Checkpoint
from tests.learn.runs.changed_arrays import change_arrays
from tests.learn.runs.flipped_bits import flipped

IDENTITY = {"scenario": "line", "preset": {"batch": 32, "hidden": [32, 32]}}


class Counts:
    """The least that can be saved: how far it has counted, and every number on the way."""

    def __init__(self) -> None:
        self.numbers: list[int] = []

    def count(self, times: int) -> "Counts":
        for _ in range(times):
            self.numbers.append(3 * len(self.numbers))
        return self

    def state(self) -> Arrays:
        return {"now": np.array([len(self.numbers)], np.uint16), "none": np.zeros((0, 7))}

    def marks(self) -> Arrays:
        return {"count": np.array([len(self.numbers)])}

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        return {"numbers": np.array(self.numbers[int(since["count"][0]) if since else 0 :], dtype=np.int64)}

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None:
        self.numbers = [int(number) for journal in journals for number in journal["numbers"]]
        assert state["now"].tolist() == [len(self.numbers)]


def loaded(folder: Path, identity: Mapping[str, Any] = IDENTITY) -> list[int]:
    counts = Counts()
    Checkpoint(folder, identity).load_into(counts)
    return counts.numbers


def test_a_saved_checkpoint_is_read_back(tmp_path: Path) -> None:
    checkpoint, counts = Checkpoint(tmp_path / "checkpoint", IDENTITY), Counts()
    assert not checkpoint.exists
    for _ in range(3):
        checkpoint.save(counts.count(2))
    state = Checkpoint(tmp_path / "checkpoint", {**IDENTITY}).state()
    assert (state["now"].tolist(), str(state["now"].dtype), state["none"].shape) == ([6], "uint16", (0, 7))
    assert loaded(tmp_path / "checkpoint") == [0, 3, 6, 9, 12, 15]


def test_a_save_writes_only_the_additions(tmp_path: Path) -> None:
    checkpoint, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    checkpoint.save(counts.count(50_000))
    checkpoint.save(counts.count(1))
    first, second = sorted(tmp_path.glob("journal-*.npz"))
    assert first.stat().st_size > 400_000
    assert second.stat().st_size < 4_000


def test_journals_are_merged_before_there_are_too_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoint_module, "MOST_JOURNALS", 3)
    checkpoint, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    for _ in range(8):
        checkpoint.save(counts.count(1))
        assert len(list(tmp_path.glob("journal-*.npz"))) <= 3
    assert loaded(tmp_path) == counts.numbers


def test_a_loaded_training_is_saved_with_its_further_additions(tmp_path: Path) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts().count(4))
    again, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    again.load_into(counts)
    again.save(counts.count(2))
    assert loaded(tmp_path) == [0, 3, 6, 9, 12, 15]


def test_a_finished_trainings_files_do_not_depend_on_the_number_of_saves(tmp_path: Path) -> None:
    Checkpoint(tmp_path / "one", IDENTITY).save(Counts().count(5), finished=True)
    often, counts = Checkpoint(tmp_path / "two", IDENTITY), Counts()
    for _ in range(5):
        often.save(counts.count(1))
    again = Checkpoint(tmp_path / "two", IDENTITY)
    again.load_into(Counts())
    again.save(counts, finished=True)
    files = [{path.name: path.read_bytes() for path in (tmp_path / name).iterdir()} for name in ("one", "two")]
    assert files[0] == files[1]
    assert loaded(tmp_path / "two") == counts.numbers


@pytest.mark.parametrize("refused_at", [1, 2])
def test_a_failed_save_leaves_the_previous_checkpoint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, refused_at: int
) -> None:
    checkpoint, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    checkpoint.save(counts.count(2))
    calls = []

    def full_disk(_: int) -> None:
        calls.append(1)
        if len(calls) == refused_at:
            raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full_disk)
        with pytest.raises(OSError, match="no space left on the disk"):
            checkpoint.save(counts.count(2))
    assert loaded(tmp_path) == [0, 3]
    checkpoint.save(counts)
    assert loaded(tmp_path) == [0, 3, 6, 9]


@pytest.mark.parametrize("name", [FILE, "journal-000000.npz"])
@pytest.mark.parametrize("kept", [0, 1, 100, 200, -1])
def test_a_truncated_checkpoint_is_refused_in_one_line(tmp_path: Path, kept: int, name: str) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts().count(3))
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[:kept])
    with pytest.raises(RunError, match="damaged or cut short: bring back a whole copy") as caught:
        loaded(tmp_path)
    assert "\n" not in str(caught.value)


def test_a_flipped_bit_anywhere_in_a_checkpoint_is_reported_as_damage(tmp_path: Path) -> None:
    checkpoint, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    for _ in range(2):
        checkpoint.save(counts.count(20))
    for file in sorted(tmp_path.iterdir()):
        whole = file.read_bytes()
        for damaged in flipped(whole, 200):
            file.write_bytes(damaged)
            with pytest.raises(RunError, match="damaged or cut short"):
                loaded(tmp_path)
        file.write_bytes(whole)
    assert loaded(tmp_path) == counts.numbers


def test_a_journal_of_another_save_is_refused_in_one_line(tmp_path: Path) -> None:
    for name, times in (("one", 3), ("two", 4)):
        Checkpoint(tmp_path / name, IDENTITY).save(Counts().count(times))
    other = tmp_path / "two" / "journal-000000.npz"
    (tmp_path / "one" / other.name).write_bytes(other.read_bytes())
    with pytest.raises(RunError, match=r"journal-000000\.npz: belongs to another save than state\.npz: bring back"):
        loaded(tmp_path / "one")


def test_two_journals_in_each_others_place_are_refused(tmp_path: Path) -> None:
    checkpoint, counts = Checkpoint(tmp_path, IDENTITY), Counts()
    for _ in range(2):
        checkpoint.save(counts.count(3))
    first, second = (tmp_path / f"journal-00000{number}.npz" for number in range(2))
    swapped = second.read_bytes(), first.read_bytes()
    first.write_bytes(swapped[0])
    second.write_bytes(swapped[1])
    with pytest.raises(RunError, match="belongs to another save"):
        loaded(tmp_path)


def test_any_archive_tool_reads_a_checkpoints_file(tmp_path: Path) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts().count(2))
    with zipfile.ZipFile(tmp_path / FILE) as archive:
        assert archive.testzip() is None
        assert len(archive.comment) == 32
    with np.load(tmp_path / FILE) as arrays:
        assert arrays["now"].tolist() == [2]


def test_a_checkpoint_of_another_scenario_is_refused(tmp_path: Path) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts())
    with pytest.raises(RunError, match="belongs to another scenario, agent or preset"):
        loaded(tmp_path, {**IDENTITY, "scenario": "diamond"})


def test_a_file_of_one_array_is_refused_as_a_damaged_checkpoint(tmp_path: Path) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts())
    with (tmp_path / FILE).open("wb") as file:
        np.save(file, np.zeros(3))
    with pytest.raises(RunError, match="damaged or cut short"):
        loaded(tmp_path)


@pytest.mark.parametrize("says", ["no JSON", "[1]", "{}", '{"identity": "0", "journals": null}'])
def test_a_checkpoint_with_an_invalid_description_is_refused_as_damaged(tmp_path: Path, says: str) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts())
    change_arrays(tmp_path / FILE, lambda arrays: arrays.update({ABOUT: np.array(says)}))
    with pytest.raises(RunError, match="damaged or cut short"):
        loaded(tmp_path)


def test_files_left_by_a_killed_save_are_removed_on_loading(tmp_path: Path) -> None:
    Checkpoint(tmp_path, IDENTITY).save(Counts().count(2))
    (tmp_path / f"{FILE}.0123abcd.unfinished").write_bytes(b"half")
    assert loaded(tmp_path) == [0, 3]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["journal-000000.npz", FILE]


def test_a_missing_checkpoint_is_refused_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="checkpoint is gone"):
        loaded(tmp_path)
