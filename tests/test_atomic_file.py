"""Atomic writes: the new file, or the old one and nothing else; what a killed process leaves is recognised."""

import os
import re
import shutil
from pathlib import Path

import pytest

from mc_nested.atomic_file import FullDiskError, atomic_write, is_leftover, refused_as, remove_leftovers
from mc_nested.errors import RunError


def test_the_file_is_replaced_at_the_end(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    path.write_text("old")
    with atomic_write(path) as unfinished:
        unfinished.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_an_error_leaves_the_old_file_and_nothing_beside_it(tmp_path: Path, error: type[BaseException]) -> None:
    path = tmp_path / "table.csv"
    path.write_text("old")

    def breaks_off() -> None:
        with atomic_write(path) as unfinished:
            unfinished.write_text("ne")
            raise error

    with pytest.raises(error):
        breaks_off()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("error", "free"),
    [
        (OSError(28, "No space left on device"), 10**9),
        (OSError("encoder error -2 when writing image file"), 0),
        (RuntimeError("enforce fail at inline_container.cc:672"), 0),
    ],
    ids=["system", "Pillow", "torch"],
)
def test_a_full_disk_is_called_one_whatever_a_library_says(
    error: Exception, free: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def breaks_off() -> None:
        with atomic_write(tmp_path / "picture.png") as unfinished:
            unfinished.write_text("ha")
            raise error

    monkeypatch.setattr("shutil.disk_usage", lambda _: shutil._ntuple_diskusage(10**9, 10**9 - free, free))
    with pytest.raises(FullDiskError) as caught:
        breaks_off()
    assert (str(caught.value), caught.value.filename) == (
        "no space left on the disk",
        str(tmp_path / "picture.png"),
    )
    assert list(tmp_path.iterdir()) == []


def test_two_writers_of_one_file_do_not_disturb_each_other(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    with atomic_write(path) as one:
        one.write_text("one")
        with atomic_write(path) as other:
            other.write_text("other")
        assert (path.read_text(), one.read_text()) == ("other", "one")
    assert path.read_text() == "one"


def test_the_file_is_on_the_disk_before_it_replaces_the_old_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "table.csv"
    path.write_text("old")
    seen = []
    monkeypatch.setattr(os, "fsync", lambda descriptor: seen.append((os.fstat(descriptor).st_size, path.read_text())))
    with atomic_write(path) as unfinished:
        unfinished.write_text("longer")
    assert seen == [(6, "old")]


def test_files_left_by_a_killed_process_are_recognised_and_removed(tmp_path: Path) -> None:
    kept = tmp_path / "state.npz"
    kept.write_text("whole")
    with atomic_write(kept) as unfinished:
        unfinished.write_text("half")
        assert is_leftover(unfinished)
        assert not is_leftover(kept)
        (tmp_path / f"copy-{unfinished.name}").write_text("half")  # as if killed here
    remove_leftovers(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["state.npz"]


def test_what_the_disk_refuses_is_one_line_with_the_file_the_reason_and_the_remedy(tmp_path: Path) -> None:
    file = tmp_path / "missing" / "table.csv"
    with (
        pytest.raises(RunError, match=rf"^{re.escape(str(file))}: can't be written \(No such file.*\): make room$"),
        refused_as(RunError, file, "make room"),
    ):
        file.write_text("new")


def test_what_the_block_itself_refuses_is_left_as_it_is(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="another"), refused_as(RunError, tmp_path, "make room"):
        raise RunError("another")
