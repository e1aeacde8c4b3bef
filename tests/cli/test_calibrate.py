"""``mc-nested calibrate``: which profile it writes, and how a calibration is undone."""

from pathlib import Path

import pytest

from mc_nested.cli.app import main
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import GameVersion, Profile


def code_of(*words: str | Path) -> int | str | None:
    with pytest.raises(SystemExit) as ended:
        main(["calibrate", *map(str, words)])
    return ended.value.code


@pytest.mark.parametrize("verb", ["all", "undo", "report", "walk", "font", "clicks"])
def test_an_empty_name_is_never_another_profile(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert code_of(verb, "--profile", "") == 2
    assert capsys.readouterr().err == "mc-nested: '' names no profile: give a name, or a file that ends in .toml\n"


def test_undo_puts_the_earlier_profile_back_and_a_second_time_the_later_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    earlier, later = Profile(), Profile(game=GameVersion(version="1.12.2"))
    save_profile(earlier, file)
    save_profile(later, file)
    for profile in (earlier, later):
        assert code_of("undo", "--profile", file) in (0, None)
        assert load_profile(file) == profile
        assert capsys.readouterr().out == f"{file} is as it was before\n"


def test_undo_without_an_earlier_profile_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert code_of("undo", "--profile", tmp_path / "new.toml") == 2
    error = capsys.readouterr().err
    assert "there is no earlier profile" in error
    assert error.count("\n") == 1


def test_undo_says_where_a_file_that_can_not_be_read_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(Profile(), file)
    save_profile(Profile(points={"other": (0.5, 0.5)}), file)
    file.write_text("[walking]\n", "utf-8")
    assert code_of("undo", "--profile", file) in (0, None)
    said = f"{file} is as it was before\nwhat stood there is no profile that can be read: it is kept in {file}.broken\n"
    assert capsys.readouterr().out == said
