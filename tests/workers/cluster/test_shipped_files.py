"""A job's files there and back."""

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.studies.outcome import OUTCOME
from mc_nested.workers.cluster.shipped_files import files_below, land, write_below

NAMES = st.sampled_from(["a", "b", "checkpoint/a", "checkpoint/deep/b"])


@given(files=st.dictionaries(NAMES, st.binary(max_size=20)))
def test_written_files_are_read_back(files: dict[str, bytes], tmp_path_factory: object) -> None:
    folder = tmp_path_factory.mktemp("files")  # type: ignore[attr-defined]  # pytest's
    write_below(folder, files)
    assert files_below(folder) == files


def test_a_folder_that_is_not_there_holds_nothing_and_a_lock_is_not_sent(tmp_path: Path) -> None:
    assert files_below(tmp_path / "none") == {}
    (tmp_path / LOCK).touch()
    assert files_below(tmp_path) == {}


def test_an_outcome_takes_the_place_of_a_checkpoint(tmp_path: Path) -> None:
    write_below(tmp_path, {"checkpoint/old": b"1", LOCK: b""})
    land(tmp_path, {OUTCOME: b"{}"})
    assert files_below(tmp_path) == {OUTCOME: b"{}"}


def test_a_checkpoint_takes_the_place_of_the_last_one_whole(tmp_path: Path) -> None:
    write_below(tmp_path, {"checkpoint/old": b"1", "checkpoint/both": b"1", "checkpoint.new/half": b"1"})
    land(tmp_path, {"checkpoint/new": b"2", "checkpoint/both": b"2"})
    assert files_below(tmp_path) == {"checkpoint/new": b"2", "checkpoint/both": b"2"}
