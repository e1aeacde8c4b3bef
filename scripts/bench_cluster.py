"""What a cluster costs: the scheduling of each job, and the speed beside local processes; and what it withstands.

    python scripts/bench_cluster.py scheduling   10,000 jobs that sleep, over 1, 2, 4 and 8 workers
    python scripts/bench_cluster.py kills        mc-nested sweep, while each of two workers is killed 20 times
    python scripts/bench_cluster.py reproduce    mc-nested reproduce in two processes, and with two workers, in turn

Starts `dask scheduler` and `dask worker` on this computer, on loopback, and ends them. Needs the extra `cluster`.
"""

import argparse
import random
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from mc_nested.arena.scenario_file import load_scenario  # noqa: E402 - found only with the line above
from mc_nested.learn.agents import AGENT_SPECS  # noqa: E402
from mc_nested.learn.experiments.jobs import Run, cut_into_jobs  # noqa: E402
from mc_nested.learn.preset import load_preset  # noqa: E402
from mc_nested.workers.cluster.address import SchedulerAddress  # noqa: E402
from mc_nested.workers.cluster.connection import connected  # noqa: E402
from mc_nested.workers.cluster.dask_jobs import DaskJobs  # noqa: E402
from mc_nested.workers.executor import train_jobs  # noqa: E402
from scripts.dask_programs import scheduler, worker  # noqa: E402

if TYPE_CHECKING:
    from distributed import Client

    from mc_nested.workers.messages import JobEnded, JobReport

SLEEPING = """
import time
from mc_nested.workers.cluster import job_task
from mc_nested.workers.messages import JobEnded, JobReport

def sleeps(job, folder, report, _):
    report(JobReport(job.name, [0], [None], 0))
    time.sleep({seconds})
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "outcome.json").write_text("{{}}")
    return JobEnded(job.name, finished=True)

job_task.train_job = sleeps
"""
"""What a worker is started with so that its jobs sleep; all else is as it is for a job that trains."""


BUSY_S = (0.0, 1.5)
"""Seconds that a worker has had a job when it is killed, at random."""


def main() -> int:
    """Run what was asked for; 1 if kills changed anything."""
    parser = argparse.ArgumentParser(description="What a cluster costs.")
    commands = parser.add_subparsers(dest="command", required=True)
    sleeping = commands.add_parser("scheduling")
    sleeping.add_argument("--jobs", type=int, default=10_000)
    sleeping.add_argument("--workers", type=int, nargs="*", default=[1, 2, 4, 8])
    sleeping.add_argument("--sleep", type=float, default=0.01, help="seconds a job")
    pairs = commands.add_parser("reproduce")
    pairs.add_argument("--rounds", type=int, default=3)
    pairs.add_argument("--trials", type=int, default=10)
    kills = commands.add_parser("kills")
    kills.add_argument("--times", type=int, default=20, help="that each worker is killed")
    kills.add_argument("--trials", type=int, default=20, help="of the sweep: enough that it outlasts the kills")
    asked = parser.parse_args()
    if asked.command == "scheduling":
        for count in asked.workers:
            _scheduling(asked.jobs, count, asked.sleep)
    elif asked.command == "kills":
        return _kills(asked.times, asked.trials)
    else:
        _reproduce(asked.rounds, asked.trials)
    return 0


def _scheduling(jobs: int, workers: int, seconds: float) -> None:
    runs = [Run("nested", AGENT_SPECS["nested"], load_preset("paper"), load_scenario("line"), 0)]
    (job,) = cut_into_jobs(runs, 1, 0)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        preload = folder / "sleeping.py"
        preload.write_text(SLEEPING.format(seconds=seconds), "utf-8")
        with _cluster(folder, workers, "--preload", str(preload)) as address, connected(address) as client:
            client.wait_for_workers(workers)
            tasks = [
                (job.__class__(**{**vars(job), "name": f"{number:05d}"}), folder / "units" / str(number))
                for number in range(jobs)
            ]
            ended: list[JobReport | JobEnded] = []
            began = time.monotonic()
            train_jobs(DaskJobs(client), tasks, lambda: False, lambda heard: ended.append(heard) if heard else None)
            took = time.monotonic() - began
    ideal = jobs * seconds / workers
    cost = 1000 * (took - ideal) / jobs
    print(
        f"{workers} workers: {jobs:,} jobs of {1000 * seconds:g} ms took {took:.1f} s, {cost:.2f} ms a job more",
        flush=True,
    )


@contextmanager
def _cluster(folder: Path, workers: int, *words: str) -> Iterator[SchedulerAddress]:
    with scheduler(folder) as url:
        running = [worker(folder, url, *words) for _ in range(workers)]
        try:
            yield SchedulerAddress(url, None)
        finally:
            for each in running:
                each.kill()
                each.wait()


def _kills(times: int, trials: int) -> int:
    """0 if the sweep ended with the same bytes as here, in which each trial has one row, after all those kills."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        words = ["sweep", "--scenario", "line", "--trials", str(trials), "--episodes", "60", "--jobs", "60"]
        here, there = folder / "here", folder / "there"
        subprocess.run(_command(*words, "--out", str(here), "-q"), check=True, cwd=ROOT)  # noqa: S603 - our own
        with scheduler(folder) as url, connected(SchedulerAddress(url, None)) as client:
            workers = [worker(folder, url, "--name", f"0-{place}") for place in range(2)]
            try:
                log = (folder / "sweep.log").open("wb")
                sweep = subprocess.Popen(_command(*words, "--out", str(there), "--cluster", url), stderr=log, cwd=ROOT)  # noqa: S603 - our own
                killed = 0
                while killed < 2 * times and sweep.poll() is None:
                    place = killed % 2
                    if not _is_busy(client, f"{killed // 2}-{place}"):
                        time.sleep(0.05)
                        continue
                    time.sleep(random.uniform(*BUSY_S))  # noqa: S311 - no secret
                    workers[place].kill()
                    workers[place].wait()
                    workers[place] = worker(folder, url, "--name", f"{killed // 2 + 1}-{place}")
                    killed += 1
                code = sweep.wait()
            finally:
                for each in workers:
                    each.kill()
                    each.wait()
        print((folder / "sweep.log").read_text("utf-8"))
        same = code == 0 and all(
            (here / name).read_bytes() == (there / name).read_bytes() for name in ("sweep.csv", "sweep.md")
        )
        jobs = len(list((there / "units").glob("*/outcome.json")))
        print(f"{killed} workers killed, exit code {code}, {jobs} jobs, {'the same' if same else 'OTHER'} bytes")
        return 0 if same and killed == 2 * times else 1


def _is_busy(client: "Client", name: str) -> bool:
    """Whether the worker of that name has a job."""
    workers = client.scheduler_info()["workers"]
    return any(each["name"] == name and client.processing([address])[address] for address, each in workers.items())


def _command(*words: str) -> list[str]:
    return [sys.executable, "-m", "mc_nested.cli", *words]


def _reproduce(rounds: int, trials: int) -> None:
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        with _cluster(folder, 2) as address:
            _time(folder / "first", 1, "--cluster", address.url)  # what is compiled at first is kept
            ratios = []
            for turn in range(rounds):
                here, there = folder / f"here-{turn}", folder / f"there-{turn}"
                local, remote = _time(here, trials, "--jobs", "2"), _time(there, trials, "--cluster", address.url)
                same = (here / "results.csv").read_bytes() == (there / "results.csv").read_bytes()
                ratios.append(local / remote)
                bytes_ = "the same" if same else "OTHER"
                print(f"{local:.1f} s here, {remote:.1f} s there: {ratios[-1]:.3f}; {bytes_} bytes", flush=True)
    print(f"median {statistics.median(ratios):.3f} of the speed of local processes")


def _time(out: Path, trials: int, *words: str) -> float:
    command = [
        sys.executable,
        "-m",
        "mc_nested.cli",
        "reproduce",
        "--trials",
        str(trials),
        "--out",
        str(out),
        "-q",
        *words,
    ]
    began = time.monotonic()
    subprocess.run(command, check=True, cwd=ROOT, stdout=subprocess.DEVNULL)  # noqa: S603 - our own
    return time.monotonic() - began


if __name__ == "__main__":
    sys.exit(main())
