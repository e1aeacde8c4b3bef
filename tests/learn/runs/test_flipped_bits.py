"""One flipped bit in any file of a training: it loads with exactly what was saved, or is refused in one line."""

from pathlib import Path

import pytest

from mc_nested.cli import training_loop
from mc_nested.learn.runs.run_folder import RunFolder
from sim.worlds import Backend
from tests.cli.running import run
from tests.learn.runs.flipped_bits import taken_as_whole

TRAININGS = {
    "paper": ["--preset", "paper", "--trials", "2"],
    "tuned": ["--preset", "tuned", "--trials", "2"],
    "model-based": ["--preset", "model-based", "--trials", "2"],
    "image": ["--preset", "image"],
    "live": ["--preset", "model-based", "--backend", "virtual"],
    "team": ["--preset", "paper", "--builders", "2"],
}


def train_half_way(words: list[str], path: Path) -> None:
    """Leave a training as its third save does: with several journals."""
    save, saves = RunFolder.save, []

    def stop_after_three(folder: RunFolder, *of: object) -> object:
        saves.append(save(folder, *of))  # type: ignore[arg-type]
        if len(saves) == 3:
            raise KeyboardInterrupt
        return saves[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(RunFolder, "save", stop_after_three)
        patch.setattr(training_loop, "SAVE_EVERY_S", dict.fromkeys(Backend, 0.0))
        assert run("train", *words, "--episodes", "8", "--seed", "3", "--quiet", "--out", path) == 130


@pytest.mark.slow
@pytest.mark.parametrize("name", TRAININGS)
def test_a_flipped_bit_in_any_file_of_any_training_is_refused_or_does_no_harm(name: str, tmp_path: Path) -> None:
    train_half_way(TRAININGS[name], tmp_path / "run")
    assert taken_as_whole(tmp_path / "run", 200) == []
    assert run("train", "--resume", tmp_path / "run", "--quiet") == 0
    assert taken_as_whole(tmp_path / "run", 200) == []
