"""Each mistake on the command line is refused in one line, before anything is written or a game is played."""

from pathlib import Path

import pytest

from tests.cli.running import check_mistake


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["frobnicate"], "No such command"),
        (["train", "--out", "NEW", "--scenario", "pyramid"], "no scenario 'pyramid'"),
        (
            ["train", "--out", "NEW", "--agent", "double"],
            "no agent 'double': choose one of nested, hierarchical, single",
        ),
        (["train", "--out", "NEW", "--preset", "fast"], "no preset 'fast'"),
        (["train", "--out", "NEW", "--trials", "0"], "'--trials'"),
        (["train", "--out", "NEW", "--episodes", "0"], "'--episodes'"),
        (["train", "--out", "NEW", "--episodes", "1" + "0" * 30], "'--episodes'"),
        (["train", "--out", "NEW", "--trials", "1" + "0" * 9], "'--trials'"),
        (["train", "--out", "NEW", "--scenario", ""], "no scenario ''"),
        (["train", "--out", "NEW" + "x" * 300], "File name too long"),
        (["train", "--out", "NEW", "--seed", "-1"], "'--seed'"),
        (["train", "--out", "NEW", "--backend", "cloud"], "'--backend'"),
        (["train", "--out", "NEW", "--backend", "live", "--trials", "2"], "one trial at a time"),
        (["train", "--out", "NEW", "--backend", "live", "--profile", "NEW.toml"], "no profile"),
        (["train", "--out", "DONE"], "is not empty: name a new folder, nothing was overwritten"),
        (["train", "--resume", "DONE", "--seed", "0"], "leave out --seed"),
        (["train", "--resume", "NEW"], "no config.toml there"),
        (["train", "--frobnicate"], "No such option"),
        (["train", "--preset", "tuned", "--agent", "single", "--out", "NEW"], "take nested or hierarchical"),
        (["play", "DONE", "--trial", "2"], "has no trial 2: choose 0 to 1"),
        (["play", "DONE", "--backend", "live", "--profile", "NEW.toml"], "no profile"),
        (["play", "DONE", "--video", "NEW.avi"], "a film is a file .mp4 or .gif"),
        (["build", "line", "--video", "NEW.avi"], "a film is a file .mp4 or .gif"),
        (["build", "line", "--backend", "virtual", "--record", "NEW"], "add --backend live, or leave out --record"),
        (["train", "--out", "NEW", "--record", "NEW"], "add --backend live, or leave out --record"),
        (["play", "DONE", "--record", "NEW"], "add --backend live, or leave out --record"),
        (["recordings", "export", "NEW", "--format", "zarr"], "Invalid value for '--format': 'zarr' is not one of"),
        (["play", "DONE", "--video", "NEW/film.gif"], "is no folder: name a film in a folder that exists"),
        (["read", "NEW.png"], "name the game's font"),
        (["read", "NEW.png", "--font", "NEW.jar"], "NEW.jar"),
        (["read", "NEW.png", "--font", "DONE/config.toml"], "config.toml"),
        (["runs", "evaluate", "NEW" + "x" * 300], "File name too long"),
        (["runs", "evaluate", "NEW"], "no config.toml there"),
        (["calibrate", "undo", "--profile", "NEW.toml"], "there is no earlier profile"),
        (["reproduce", "--preset", "tuned", "--out", "NEW"], "is not for the single agent"),
        (["study", "beyond", "--device", "mps", "--out", "NEW"], "mps"),
        (["study", "robustness", "--preset", "tuned"], "is not for the single agent"),
        (["study", "robustness", "--scenario", "line", "--scenario", "line"], "two scenarios are named 'line'"),
        (["study", "sweep", "--designs", "3"], "mc-nested: No such option: --designs\n"),
        (["study", "ablation", "--resume", "NEW", "--trials", "3"], "leave out --trials"),
        (
            ["study", "ablation", "--out", "NEW", "--scenario", "flag"],
            "[imagination] knows no parts, and flag has some",
        ),
        (
            ["study", "ablation", "--out", "NEW", "--scenario", "line", "--scenario", "line"],
            "two scenarios are named 'line'",
        ),
    ],
)
def test_mistake_is_refused_in_one_line_with_exit_code_2(
    words: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check_mistake(words, says, trained, tmp_path, capsys)
