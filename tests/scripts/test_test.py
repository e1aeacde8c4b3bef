"""scripts/test.py: its announcement, its table, and its going on after a failure."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from scripts.test import ALL, COMMIT, KERNELS, SuiteCheck, announcement, main, run_all, table

ROOT = Path(__file__).parents[2]
PYTHON = Path(sys.executable)

# Starts what stays, and says so; ends what it has started when it is ended.
STAYS = (
    "import subprocess, sys; "
    "subprocess.run([sys.executable, '-c', 'import time; print(1, flush=True); time.sleep(60)'])"
)


def script(code: str, *, is_beside: bool = False) -> SuiteCheck:
    return SuiteCheck([PYTHON.name, "-c", code], 1, is_beside=is_beside)


@pytest.mark.parametrize("path", KERNELS)
def test_every_listed_test_of_compiled_code_exists(path: str) -> None:
    assert (ROOT / path).is_file()


def test_checks_of_a_commit_are_a_part_of_all_checks() -> None:
    assert set(COMMIT) < set(ALL)


def test_the_announcement_says_how_long_each_check_takes_and_what_is_fetched() -> None:
    checks = {
        "quick": SuiteCheck(["a"], 0.5),
        "beside": SuiteCheck(["b"], 10, is_beside=True),
        "real-time tests": SuiteCheck(["c"], 4, downloads="1.8 GB for Wine"),
    }
    said = announcement(checks)
    assert "  beside                         about 10 min" in said
    assert any(line.startswith("About 10 min in all") for line in said)  # 0.5 + 4, and the 6 that are left of 10
    assert any("1.8 GB for Wine" in line for line in said)


def test_the_checks_go_on_after_a_failure_which_the_table_shows(capfd: pytest.CaptureFixture[str]) -> None:
    checks = {
        "first": script("import sys; sys.exit(3)"),
        "beside": script("print('from beside')", is_beside=True),
        "last": script("print('from the last')"),
    }
    outcomes = run_all(checks, PYTHON.parent)
    assert [outcome.code for outcome in outcomes.values()] == [3, 0, 0]
    assert list(outcomes) == ["first", "beside", "last"]
    said = capfd.readouterr().out
    assert said.index("\nfrom the last") < said.index("\nfrom beside")
    assert [row.split()[:2] for row in table(outcomes)] == [
        ["failed", "first"],
        ["passed", "beside"],
        ["passed", "last"],
    ]


def test_failed_tests_are_listed_below_their_checks_row_with_what_was_wrong(tmp_path: Path) -> None:
    test_file = tmp_path / "test_two.py"
    test_file.write_text("def test_right(): pass\ndef test_wrong(): assert 1 + 1 == 3\n")
    check = SuiteCheck(["pytest", "-q", "-p", "no:cacheprovider", f"--rootdir={tmp_path}", str(test_file)], 1)
    first, second = table(run_all({"unit tests": check}, PYTHON.parent))
    assert first.startswith("failed  unit tests")
    test, *why = (line.strip() for line in second.splitlines())
    assert test == "test_two::test_wrong"
    assert why == ["assert (1 + 1) == 3"]


def test_unknown_check_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["--only", "nothing"])
    assert ended.value.code == 2
    assert "invalid choice: 'nothing'" in capsys.readouterr().err


@pytest.mark.skipif(os.name != "posix", reason="Windows sends no signal to a group")
@pytest.mark.parametrize("is_beside", [False, True])
def test_ctrl_c_ends_every_process_that_was_started(*, is_beside: bool) -> None:
    checks = "{'beside': beside, 'stays': stays}" if is_beside else "{'stays': stays}"
    program = (
        "import sys; from pathlib import Path; from scripts.test import SuiteCheck, run_all\n"
        f"stays = SuiteCheck([Path(sys.executable).name, '-c', {STAYS!r}], 1)\n"
        "beside = SuiteCheck(stays.command, 1, is_beside=True)\n"
        f"run_all({checks}, Path(sys.executable).parent)"
    )
    command = [sys.executable, "-c", program]
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, start_new_session=True
    ) as running:
        assert running.stdout is not None
        while running.stdout.readline() != "1\n":
            pass
        os.killpg(running.pid, signal.SIGINT)  # as the terminal does
        running.wait(30)
        # A child that outlived its parent for a moment is there until the system's first process has noticed its end.
        gone_by = time.monotonic() + 30
        while is_left(running.pid) and time.monotonic() < gone_by:
            time.sleep(0.1)
        assert not is_left(running.pid)


def is_left(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
