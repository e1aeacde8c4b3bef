"""One flipped bit in any file of a training: it loads with exactly what was saved, or is refused in one line."""

import shutil
from pathlib import Path

import pytest

from mc_nested.cli import training_loop
from mc_nested.errors import RunError
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome, outcome_of, write_outcome
from sim.worlds import Backend
from tests.cli.running import run
from tests.learn.made_experiments import DOT, one_job
from tests.learn.runs.flipped_bits import flipped, taken_as_whole

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


@pytest.fixture(scope="module")
def short(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("runs") / "run"
    train_half_way(TRAININGS["paper"], path)
    return path


def test_a_flipped_bit_in_any_file_of_a_training_is_refused_or_does_no_harm(short: Path) -> None:
    assert taken_as_whole(short, 20) == []


@pytest.mark.parametrize("words", [["train", "--resume", "RUN"], ["play", "RUN"], ["runs", "evaluate", "RUN"]])
@pytest.mark.parametrize("name", ["state.npz", "journal-000001.npz", "summary.json"])
def test_a_verb_refuses_a_damaged_file_that_it_needs_in_one_line(
    words: list[str], name: str, short: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(short, tmp_path / "run")
    (file,) = (tmp_path / "run").rglob(name)
    whole = file.read_bytes()
    file.write_bytes(
        whole.replace(b'"wall_s": ', b'"wall_s": 1') if name == "summary.json" else next(flipped(whole, 1))
    )
    capsys.readouterr()
    code = run(*(word.replace("RUN", str(tmp_path / "run")) for word in words))
    if name == "state.npz" or words[0] == "train":
        assert code == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"mc-nested: {file}: ")
    else:
        assert code == 0, "it takes nothing from that file"


def test_a_flipped_bit_in_a_jobs_outcome_is_refused_or_does_no_harm(tmp_path: Path) -> None:
    job = one_job("nested", [DOT], 2)
    told = Evaluated(episode=5, score=11.0, material="stone", steps=4)
    runs = [RunOutcome(evaluations=[told], score=score, updates=31, env_steps=77) for score in (11.0, 10.5)]
    outcome = JobOutcome(identity=fingerprint(job.identity()), networks=2, parameters=99, seconds=1.234, runs=runs)
    write_outcome(tmp_path, outcome)
    assert outcome_of(job, tmp_path) == outcome
    refused = []
    for damaged in flipped((tmp_path / "outcome.json").read_bytes(), 200):
        (tmp_path / "outcome.json").write_bytes(damaged)
        try:
            assert outcome_of(job, tmp_path) == outcome
        except RunError as error:
            refused.append(str(error))
    assert len(refused) > 150
    assert not any("\n" in line for line in refused)


@pytest.mark.slow
@pytest.mark.parametrize("name", TRAININGS)
def test_a_flipped_bit_in_any_file_of_any_training_is_refused_or_does_no_harm(name: str, tmp_path: Path) -> None:
    train_half_way(TRAININGS[name], tmp_path / "run")
    assert taken_as_whole(tmp_path / "run", 200) == []
    assert run("train", "--resume", tmp_path / "run", "--quiet") == 0
    assert taken_as_whole(tmp_path / "run", 200) == []
