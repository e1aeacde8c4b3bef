"""Which command a folder belongs to, whether it can be new, and that a newer version's is refused."""

from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_kind import FORMAT, VIEW, VIEW_FILES, check_config, check_free


@pytest.mark.parametrize(
    ("key", "verb"),
    [('agent = "nested"', "train"), ('study = "reproduce"', "reproduce"), ('study = "sweep"', "study sweep")],
)
def test_a_folder_is_refused_by_every_command_but_the_one_that_made_it(key: str, verb: str) -> None:
    text = f"format = {FORMAT}\n{key}"
    check_config(text, Path("runs/x"), verb)
    other = "study sweep" if verb == "train" else "train"
    with pytest.raises(RunError, match=f"the folder of mc-nested {verb}, not of {other}: .* --resume runs/x"):
        check_config(text, Path("runs/x"), other)


@pytest.mark.parametrize("written", ["", "format = 1", f"format = {FORMAT + 1}"])
def test_a_folder_of_another_version_is_refused(written: str) -> None:
    with pytest.raises(RunError, match="another version of mc-nested: open it with that one, or train it again"):
        check_config(f'agent = "nested"\n{written}', Path("runs/x"), "train")


def test_a_folder_is_free_if_missing_empty_or_holding_unfinished_files_alone(tmp_path: Path) -> None:
    check_free(tmp_path / "missing")
    check_free(tmp_path)
    (tmp_path / "config.toml.0123abcd.unfinished").write_text("half")
    check_free(tmp_path)


def test_view_files_leave_a_folder_free_and_any_other_file_beside_them_does_not(tmp_path: Path) -> None:
    view = tmp_path / VIEW
    view.mkdir()
    check_free(tmp_path)
    for name in VIEW_FILES:
        (view / name).write_text("")
    (view / "now.unfinished").write_text("half")
    check_free(tmp_path)
    (view / "mine.txt").write_text("mine")
    with pytest.raises(RunError, match="exists and is not empty"):
        check_free(tmp_path)


def test_a_file_named_like_the_view_folder_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / VIEW).write_text("mine")
    with pytest.raises(RunError, match="exists and is not empty"):
        check_free(tmp_path)


def test_a_file_or_a_folder_with_files_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "config.toml.0123abcd.unfinished").write_text("half")
    for path, what in ((tmp_path, "exists and is not empty"), (tmp_path / "notes.txt", "is a file")):
        with pytest.raises(RunError, match=f"{what}: name a new folder, nothing was overwritten"):
            check_free(path)
