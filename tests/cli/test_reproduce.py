"""``mc-nested reproduce`` with tiny sizes: its files, the same after every stop, and its refusals."""

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from mc_nested.cli import study as study_module
from mc_nested.cli.output import json_fields
from mc_nested.cli.reproduce import reproduce
from mc_nested.learn.runs.checkpoint import FILE
from mc_nested.studies.reproduce import STUDY
from tests.cli.running import check_mistake, check_one_at_a_time, run, table, write_study
from tests.full_disk import full_disk
from tests.learn.made_experiments import BAR, DOT, small_preset_text

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals for other processes")

FILES = STUDY.files
WRITTEN = ("results.csv", "figure5.png", "figure5.svg", "report.md")


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("files")
    write_study(folder, DOT, BAR)
    return folder


@pytest.fixture(scope="module")
def words(files: Path) -> list[str]:
    return ["reproduce", *write_study(files, DOT, BAR), "--seed", "5"]


@pytest.fixture(scope="module")
def done(words: list[str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("done") / "run"
    assert run(*words, "--jobs", "1", "--out", out) == 0
    return out


def written(folder: Path) -> dict[str, bytes]:
    """Return the files that it ends with, the report without its lines that name seconds."""
    found = {name: (folder / name).read_bytes() for name in WRITTEN}
    return {**found, "report.md": re.sub(rb"(?m)^.*[Ss]econds.*$", b"", found["report.md"])}


@pytest.mark.parametrize(
    "verb", [("runs", "evaluate"), ("play",), ("train", "--resume"), ("study", "sweep", "--resume")]
)
def test_other_verbs_refuse_the_folder_and_name_reproduce(
    done: Path, verb: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*verb, done) == 2
    assert "the folder of mc-nested reproduce, not of" in capsys.readouterr().err


def test_reproduction_writes_its_results_and_keeps_config_jobs_and_tensorboard(done: Path) -> None:
    assert {path.name for path in done.iterdir()} == {*WRITTEN, "config.toml", "jobs", "tensorboard"}
    runs = {f"{a}-{s}-{t}" for a in ("nested", "hierarchical", "single") for s in ("dot", "bar") for t in (0, 1)}
    assert {path.name for path in (done / "tensorboard").iterdir()} == runs
    rows = table(done / "results.csv")
    own = [row for row in rows if (row["agent"], row["scenario"], row["trial"]) == ("single", "bar", "1")]
    assert [row["episode"] for row in own] == ["5", "10", "15", "20"]
    assert len(rows) == 3 * 2 * 2 * 4
    assert [path.name for path in sorted((done / "jobs").rglob("*")) if path.is_file()] == [
        *["outcome.json"] * 3,
        "config.sha256",
    ]
    report = (done / "report.md").read_text("utf-8")
    assert "Preset `small`, seed 5: 2 trials of 20 episodes" in report
    assert re.search(r"\| dot \| hierarchical \| 3 \(1\.50\) \|", report), "networks, and times the nested agent's"


def test_train_with_the_same_seed_gives_the_reproductions_scores(done: Path, files: Path, tmp_path: Path) -> None:
    assert (
        run("train", "--agent", "hierarchical", *write_study(files, BAR), "--seed", "5", "--out", tmp_path / "run") == 0
    )
    alone = (tmp_path / "run" / "evaluations.csv").read_text().splitlines()[1:]
    rows = [row for row in table(done / "results.csv") if (row["agent"], row["scenario"]) == ("hierarchical", "bar")]
    assert sorted((int(row["trial"]), int(row["episode"]), float(row["score"])) for row in rows) == sorted(
        (int(trial), int(episode), float(score)) for trial, episode, score, *_ in (line.split(",") for line in alone)
    )


def test_resuming_a_finished_reproduction_writes_the_same_files_again(
    done: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = {name: (done / name).read_bytes() for name in WRITTEN}
    (done / "report.md").unlink()
    assert run("reproduce", "--resume", done) == 0
    assert {name: (done / name).read_bytes() for name in WRITTEN} == before
    printed = capsys.readouterr().out
    assert re.search(r"\(e1\)  nested needs fewer networks and parameters than hierarchical +holds", printed)
    assert f"report: {done / 'report.md'}" in printed
    assert printed.startswith(f"folder: {done}\n")
    assert printed.endswith(f"next:   open {done / 'report.md'}\n")


def test_a_reproduction_is_resumed_by_one_process_at_a_time(done: Path, capsys: pytest.CaptureFixture[str]) -> None:
    check_one_at_a_time(["reproduce"], done, capsys)


def test_json_has_the_files_and_the_verdicts(done: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("reproduce", "--resume", done, "--json", "--quiet") == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert found.keys() == json_fields(reproduce).keys()
    assert found["folder"] == str(done)
    assert found["files"] == {what: str(done / name) for what, name in FILES.items()}
    assert [claim["letter"] for claim in found["claims"]][:4] == ["a1", "a2", "a3", "b"]
    assert {"holds"} < {claim["verdict"] for claim in found["claims"]}
    assert printed.err == ""


def test_folder_without_a_name_is_named_after_the_figure_and_the_date(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[Path] = []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(study_module, "run_study", lambda _study, folder, *_: begun.append(folder.path))
    assert run(*words) == 0
    assert re.fullmatch(r"figure5-\d{4}-\d\d-\d\d-\d{6}", begun[0].name)


@pytest.mark.slow
def test_any_number_of_processes_gives_the_same_files(done: Path, words: list[str], tmp_path: Path) -> None:
    assert run(*words, "--jobs", "3", "--out", tmp_path / "run") == 0
    assert written(tmp_path / "run") == written(done)


@contextlib.contextmanager
def long_one(words: list[str], out: Path, episodes: int) -> Iterator[subprocess.Popen[str]]:
    """Yield a run of its own, from the moment at which both its processes have saved something.

    All its processes are killed at the end.
    """
    command = [sys.executable, "-m", "mc_nested.cli", *words, "--episodes", f"{episodes}", "--jobs", "2"]
    process = subprocess.Popen([*command, "--out", str(out)], stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        wait_until(lambda: len(list(out.glob(f"jobs/*/checkpoint/{FILE}"))) >= 2)
        yield process
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def wait_until(happened: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60
    while not happened():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def children(process: subprocess.Popen[str]) -> list[int]:
    return [int(pid) for pid in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]


def training_processes(process: subprocess.Popen[str]) -> list[int]:
    """Return those of the children that aren't multiprocessing's own."""
    return [pid for pid in children(process) if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()]


LONG = 480
"""Episodes that take two seconds and more: none of the trainings is over when their first checkpoints are seen."""


@pytest.fixture(scope="module")
def straight(words: list[str], tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    out = tmp_path_factory.mktemp("straight") / "run"
    assert run(*words, "--episodes", f"{LONG}", "--jobs", "1", "--out", out) == 0
    return written(out)


@pytest.mark.slow
def test_a_killed_reproduction_is_resumed_to_the_same_files(
    words: list[str], straight: dict[str, bytes], tmp_path: Path
) -> None:
    out = tmp_path / "run"
    with long_one(words, out, LONG) as process:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    assert not (out / "report.md").exists()
    assert run("reproduce", "--resume", out) == 0
    assert written(out) == straight


@pytest.mark.slow
@pytest.mark.parametrize("whole_group", [True, False], ids=["in a terminal", "to the command alone"])
def test_ctrl_c_saves_and_says_how_to_resume(
    words: list[str], straight: dict[str, bytes], tmp_path: Path, whole_group: bool
) -> None:
    out = tmp_path / "run"
    with long_one(words, out, LONG) as process:
        if whole_group:
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said.strip() == f"mc-nested: stopped and saved: go on with mc-nested reproduce --resume {out}"
    assert run("reproduce", "--resume", out) == 0
    assert written(out) == straight


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="finds the processes in /proc")
@pytest.mark.parametrize(
    ("number", "says"),
    [
        (signal.SIGKILL, "a training process was killed (SIGKILL)"),
        (signal.SIGTERM, "a training process was asked to stop"),
    ],
)
def test_lost_training_process_is_reported_in_one_line_and_resume_gives_the_same_files(
    words: list[str], straight: dict[str, bytes], tmp_path: Path, number: signal.Signals, says: str
) -> None:
    out = tmp_path / "run"
    with long_one(words, out, LONG) as process:
        os.kill(training_processes(process)[0], number)
        _, said = process.communicate(timeout=60)
    assert process.returncode == 2
    assert said.startswith(f"mc-nested: {says}")
    assert said.count("\n") == 1
    assert f"mc-nested reproduce --resume {out} goes on from what was saved" in said
    assert run("reproduce", "--resume", out) == 0
    assert written(out) == straight


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="finds the processes in /proc")
def test_training_processes_end_if_the_command_is_killed(words: list[str], tmp_path: Path) -> None:
    with long_one(words, tmp_path / "run", 100_000) as process:
        left = training_processes(process)
        process.kill()
        process.wait()
        wait_until(lambda: not any(Path(f"/proc/{pid}").exists() for pid in left))


def test_full_disk_at_the_end_is_reported_in_one_line_and_costs_no_file(
    done: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    before = written(done)
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", full_disk)
    assert run("reproduce", "--resume", done) == 2
    said = capsys.readouterr().err
    assert "no space left on the disk" in said
    assert f"make room, then mc-nested reproduce --resume {done} goes on" in said
    assert said.count("\n") == 1
    assert written(done) == before


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["reproduce", "--out", "DONE"], "is not empty: name a new folder, nothing was overwritten"),
        (["reproduce", "--out", "NEW", "--trials", "0"], "'--trials'"),
        (["reproduce", "--out", "NEW", "--episodes", "0"], "'--episodes'"),
        (["reproduce", "--out", "NEW", "--jobs", "0"], "'--jobs'"),
        (["reproduce", "--out", "NEW", "--longer", "1"], "'--longer'"),
        (["reproduce", "--out", "NEW", "--agent", "double"], "no agent 'double': choose one of nested, hierarchical"),
        (
            ["reproduce", "--out", "NEW", "--agent", "single", "--longer", "10"],
            "--longer is for nested and hierarchical",
        ),
        (["reproduce", "--out", "NEW", "--scenario", "line", "--longer", "10"], "on zigzag and diamond"),
        (["reproduce", "--out", "NEW", "--scenario", "line", "--scenario", "line"], "two scenarios are named 'line'"),
        (["reproduce", "--out", "NEW", "--preset", "ODD"], "unknown key"),
        (["reproduce", "--resume", "NEW"], "no config.toml there: name a folder of mc-nested reproduce"),
        (["reproduce", "--resume", "DONE", "--seed", "0"], "goes on with its own config.toml: leave out --seed"),
        (["reproduce", "--resume", "DONE", "--agent", "nested"], "leave out --agent"),
        (["reproduce", "--resume", "DONE", "--out", "NEW"], "leave out --out"),
        (["study", "sweep", "--out", "NEW", "--trials", "0"], "'--trials'"),
        (["study", "sweep", "--resume", "DONE"], "the folder of mc-nested reproduce, not of study sweep"),
    ],
)
def test_mistake_is_refused_in_one_line_with_exit_code_2(
    arguments: list[str], says: str, done: Path, files: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    odd = files / "odd.toml"
    odd.write_text(small_preset_text() + "\nlearning_rte = 1\n", "utf-8")
    check_mistake([word.replace("ODD", str(odd)) for word in arguments], says, done, tmp_path, capsys)
