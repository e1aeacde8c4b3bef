"""README's second command: the checks that a commit must pass, in the project's own environment; with --all, every one.

Usage: python scripts/test.py [--all | --only NAME]

Every check is run, even after one has failed. Exit code 1 where any failed, 130 after Ctrl+C.
"""

from __future__ import annotations  # an older Python reads this file, too, and says so

import argparse
import shutil
import sys
import tempfile
import time
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from typing import TYPE_CHECKING

from scripts import environment

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Iterator, Mapping, Sequence

EXTRAS = ["dev", "bench"]
"""What is installed beside the project: bench brings stable-baselines3, which an example and the benchmark train."""

REAL = "standin or realtime or window or wine"
"""The markers of the tests that play in real time."""

OTHERS = f"slow or {REAL}"
"""The markers of the tests that the unit suite leaves out."""

KERNELS = [
    "tests/learn/dqn/compiled_engine/test_adam.py",
    "tests/learn/dqn/compiled_engine/test_cell_networks.py",
    "tests/learn/dqn/compiled_engine/test_products.py",
    "tests/learn/imagination/test_arena_step.py",
    "tests/learn/imagination/test_built_values.py",
    "tests/learn/imagination/test_practice_kernel.py",
    "tests/learn/imagination/test_table_learner.py",
    "tests/sim/test_grid.py",
]
"""Tests of compiled code that is quick enough in plain Python, where an index out of bounds is an error."""

MOST_LINES, WIDEST = 12, 300
"""How much of a failed test's reason the table shows: a log may be cut in its middle, where the traceback is."""

LOOK_S = 0.5
"""Seconds between two looks at a check that runs beside others."""


@dataclass(frozen=True)
class SuiteCheck:
    """One row: a command of the environment, and about how many minutes it takes on two cores.

    ``variables`` are environment variables; ``downloads`` what it fetches on a new machine; ``is_beside`` whether it
    runs beside the checks that follow, which wait more than they compute, and gives way to them.
    """

    command: Sequence[str]
    minutes: float
    variables: Mapping[str, str] = field(default_factory=dict)
    downloads: str = ""
    is_beside: bool = False


STATIC = {
    "lint": SuiteCheck(["ruff", "check", "."], 0.1),
    "format": SuiteCheck(["ruff", "format", "--check", "."], 0.1),
    "types": SuiteCheck(["mypy"], 0.7),
    "import contracts": SuiteCheck(["lint-imports"], 0.2),
}

UNIT = ["pytest", "-n", "2", "--dist", "loadfile", "-m", f"not ({OTHERS})"]

COMMIT = {**STATIC, "unit tests": SuiteCheck(UNIT, 7)}
"""What a commit must pass."""

ALL = {
    **STATIC,
    # The warning says that mkdocs-material ends in 2027.
    "documentation": SuiteCheck(["mkdocs", "build", "--strict"], 0.3, {"NO_MKDOCS_2_WARNING": "1"}),
    "compiled code in plain Python": SuiteCheck(
        ["pytest", *KERNELS, "--cov", "--cov-report=", "--cov-fail-under=0"], 0.3, {"NUMBA_DISABLE_JIT": "1"}
    ),
    "unit tests": SuiteCheck([*UNIT, "--hypothesis-profile=all", "--cov", "--cov-append", "--cov-report="], 10),
    "branch coverage": SuiteCheck(["coverage", "report", "--skip-covered"], 0.2),
    "slow tests": SuiteCheck(
        ["pytest", "-n", "2", "--dist", "loadgroup", "-m", f"slow and not ({REAL})"], 36, is_beside=True
    ),
    "real-time tests": SuiteCheck(
        ["pytest", "-n", "2", "--dist", "loadgroup", "-m", "realtime or window or wine"],
        21,
        downloads="2.2 GB for Wine, a Windows Python, Java and an input method",
    ),
    "stand-in tests": SuiteCheck(["pytest", "-m", "standin"], 6, downloads="0.8 GB for the stand-in, a browser's game"),
}
"""Everything that CI runs."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the checks that are asked for; returns the exit code."""
    parser = argparse.ArgumentParser(description="The checks that a commit must pass, and with --all every other.")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--all", action="store_true", help="everything that CI runs")
    which.add_argument("--only", metavar="NAME", choices=ALL, help=f"one check of --all: {', '.join(ALL)}")
    wanted = parser.parse_args(arguments)
    checks = {wanted.only: ALL[wanted.only]} if wanted.only else ALL if wanted.all else COMMIT
    print("\n".join(announcement(checks)), flush=True)
    try:
        outcomes = run_all(checks, environment.main_python(EXTRAS).parent)
    except KeyboardInterrupt:
        print("\nstopped")
        return 130
    print("\n" + "\n".join(table(outcomes)))
    return 1 if any(outcome.code for outcome in outcomes.values()) else 0


def announcement(checks: Mapping[str, SuiteCheck]) -> list[str]:
    """Say what will be run, how long that takes, and what is fetched for it."""
    rows = [f"  {name:<30} about {check.minutes:g} min" for name, check in checks.items()]
    beside = [check.minutes for check in checks.values() if check.is_beside]
    alone = sum(check.minutes for check in checks.values() if not check.is_beside)
    real = sum(check.minutes for name, check in checks.items() if name in ("real-time tests", "stand-in tests"))
    minutes = alone + max(0.0, sum(beside) - real)
    downloads = ["the project's packages, torch among them, if .venv lacks them"]
    downloads += [f"{check.downloads}, on Linux as root" for check in checks.values() if check.downloads]
    return [
        *("Runs, on two cores:", *rows),
        f"About {max(1, round(minutes))} min in all; more the first time, when what is compiled is compiled.",
        f"Downloads: {'; '.join(downloads)}.",
    ]


@dataclass(frozen=True)
class CheckOutcome:
    """A check's exit code, how many seconds it took, and its tests that failed."""

    code: int
    seconds: float
    failed: Sequence[str] = ()


def run_all(checks: Mapping[str, SuiteCheck], programs: Path) -> dict[str, CheckOutcome]:
    """Run each check, and return its outcome; one that runs beside others is shown after them."""
    ended: dict[str, tuple[int, float]] = {}
    with ExitStack() as stack:
        reports = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        beside: dict[str, BesideRun] = {}
        for name, check in checks.items():
            command: list[str | Path] = [programs / check.command[0], *check.command[1:]]
            print(f"\n== {name}: {' '.join(check.command)}", flush=True)
            if check.command[0] == "pytest":
                command.append(f"--junitxml={reports / name}.xml")
            if check.is_beside and len(checks) > 1:
                print("runs beside the checks that follow, and is shown after them", flush=True)
                beside[name] = stack.enter_context(running_beside(command, check.variables))
                continue
            began = time.monotonic()
            ended[name] = environment.run(command, check.variables), time.monotonic() - began
        for name, run in beside.items():
            print(f"\n== {name}, beside the checks before", flush=True)
            ended[name] = run.show()
        return {name: CheckOutcome(*ended[name], failed_tests(reports / f"{name}.xml")) for name in checks}


def failed_tests(report: Path) -> list[str]:
    """Return the tests that failed by pytest's report in JUnit's format, and why; none where there is no report."""
    return [f"{module}::{name}{why(fault)}" for module, name, fault in cases_in(report) if fault is not None]


def why(fault: str) -> str:
    """Return the lines of pytest's traceback that say what was wrong, cut to a few, each on a line of its own."""
    said = [line[1:].strip() for line in fault.splitlines() if line.startswith("E ")]
    return "".join(f"\n            {line[:WIDEST]}" for line in said[:MOST_LINES])


def cases_in(report: Path) -> list[tuple[str, str, str | None]]:
    """Return each test that was run, as pytest's report says: its module, its name, and its failure if it failed."""
    if not report.exists():
        return []
    found: list[tuple[str, str, str | None]] = []
    for case in ElementTree.parse(report).iter("testcase"):  # noqa: S314 - pytest wrote it
        if case.find("skipped") is None:
            faults = [fault.text or "failed" for kind in ("failure", "error") for fault in case.findall(kind)]
            found.append((case.get("classname", ""), case.get("name", ""), "\n".join(faults) or None))
    return found


@dataclass(frozen=True)
class BesideRun:
    """A command that runs since ``began``, and the file that it prints into."""

    process: subprocess.Popen[bytes]
    printed: Path
    began: float

    def show(self) -> tuple[int, float]:
        """Print what it has printed, and what it goes on to print; returns its exit code and how long it took."""
        with self.printed.open(encoding="utf-8", errors="replace") as printed:
            while True:
                code = self.process.poll()
                print(printed.read(), end="", flush=True)
                if code is not None:
                    return code, time.monotonic() - self.began
                time.sleep(LOOK_S)


@contextmanager
def running_beside(command: Sequence[str | Path], variables: Mapping[str, str]) -> Iterator[BesideRun]:
    """Run a command that gives way to others until the block ends, and ends with it."""
    # nice counts among the processes of one session alone, so this gets none of its own.
    gives_way = ["nice", "-n", "19"] if shutil.which("nice") else []
    with tempfile.TemporaryDirectory() as folder:
        printed = Path(folder) / "printed.txt"
        with printed.open("wb") as output:
            process = environment.start([*gives_way, *command], variables, output.fileno())
        try:
            yield BesideRun(process, printed, time.monotonic())
        finally:
            environment.end(process)


def table(outcomes: Mapping[str, CheckOutcome]) -> list[str]:
    """Return a row a check: whether it passed, and how long it took; below it the tests that failed, and why."""
    rows = []
    for name, outcome in outcomes.items():
        rows.append(f"{'failed' if outcome.code else 'passed'}  {name:<30} {outcome.seconds:6.0f} s")
        rows.extend(f"        {test}" for test in outcome.failed)
    return rows


if __name__ == "__main__":
    sys.exit(main())
