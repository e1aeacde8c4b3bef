"""An experiment on a cluster writes the same bytes as here, and goes on there or here."""

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.cli.running import run, write_study
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT
from tests.workers.cluster.dask_programs import scheduler, worker

__all__ = ["leftovers"]


pytestmark = [pytest.mark.slow, LEFTOVERS]

FILES = ("results.csv", "figure5.png")


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("cluster")
    with scheduler(folder) as address:
        workers = [worker(folder, address) for _ in range(2)]
        try:
            yield address
        finally:
            for each in workers:
                each.kill()
                each.wait()


@pytest.fixture(scope="module")
def words(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    return ["reproduce", *write_study(tmp_path_factory.mktemp("made"), DOT), "-q"]


@pytest.fixture(scope="module")
def here(words: list[str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("experiments") / "here"
    assert run(*words, "--jobs", "1", "--out", out) == 0
    return out


def content(out: Path) -> dict[str, bytes]:
    return {name: (out / name).read_bytes() for name in FILES}


@pytest.mark.parametrize("jobs", ["1", "7"])
def test_experiment_on_a_cluster_writes_the_same_bytes_as_here(
    jobs: str, url: str, words: list[str], here: Path, tmp_path: Path
) -> None:
    assert run(*words, "--cluster", url, "--jobs", jobs, "--out", tmp_path / "there") == 0
    assert content(tmp_path / "there") == content(here)


@pytest.fixture(scope="module")
def long(words: list[str]) -> list[str]:
    return [*words, "--episodes", "1500", "--jobs", "2", "--seed", "1"]


@pytest.fixture(scope="module")
def whole(long: list[str], tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    out = tmp_path_factory.mktemp("experiments") / "whole"
    assert run(*long, "--out", out) == 0
    return content(out)


@pytest.mark.parametrize(("first", "then"), [([], ["--cluster", "URL"]), (["--cluster", "URL"], [])])
def test_experiment_stopped_here_or_on_a_cluster_is_resumed_on_the_other_to_the_same_bytes(
    first: list[str], then: list[str], url: str, long: list[str], whole: dict[str, bytes], tmp_path: Path
) -> None:
    cut = tmp_path / "cut"
    stopped = [sys.executable, "-m", "mc_nested.cli", *long, "--out", str(cut)]
    training = subprocess.Popen([*stopped, *(word.replace("URL", url) for word in first)])
    while training.poll() is None and not list(cut.glob("jobs/*/outcome.json")):
        time.sleep(0.05)
    training.send_signal(signal.SIGINT)
    assert training.wait(60) == 130
    assert any((job / "checkpoint").is_dir() for job in (cut / "jobs").iterdir() if job.is_dir())
    assert run("reproduce", "--resume", cut, *(word.replace("URL", url) for word in then)) == 0
    assert content(cut) == whole


def test_sweep_and_benchmark_write_the_same_bytes_on_a_worker_with_a_nanny(words: list[str], tmp_path: Path) -> None:
    _, *own, trials, one, quiet = words
    sweep = ["study", "sweep", *own, trials, one, "--episodes", "2", quiet]
    benchmark = ["study", "benchmark", "--designs", "1", "--agents", "nested", "--presets", words[4]]
    benchmark += ["--trials", "1", quiet]
    written = {"sweep": ("sweep.csv", "sweep.md"), "benchmark": ("benchmark.csv",)}
    with scheduler(tmp_path) as url:
        nanny = worker(tmp_path, url, "--nanny")
        try:
            for verb in (sweep, benchmark):
                here, there = tmp_path / verb[1] / "here", tmp_path / verb[1] / "there"
                assert run(*verb, "--jobs", "2", "--out", here) == 0
                assert run(*verb, "--jobs", "2", "--out", there, "--cluster", url) == 0
                for name in written[verb[1]]:
                    assert (there / name).read_bytes() == (here / name).read_bytes()
        finally:
            nanny.terminate()
            nanny.wait(30)
