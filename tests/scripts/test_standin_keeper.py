"""The process that stays behind. Forks, so each case runs in an interpreter of its own."""

import subprocess
import sys
from pathlib import Path

import pytest

from scripts.standin import ROOT

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the stand-in is for Linux")

SCRIPT = """
import os, signal, subprocess, sys, time
sys.path.insert(0, {root!r})
from scripts.standin_keeper import stay_behind
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGTERM, signal.default_int_handler)
{before}
def work():
{work}
print(stay_behind(work), flush=True)
"""


def run(work: str, timeout_s: float = 30, before: str = "") -> subprocess.CompletedProcess[str]:
    """What a script says that leaves ``work`` to a keeper: returns once nobody holds its output any more."""
    lines = "\n".join(f"    {line}" for line in work.splitlines())
    code = SCRIPT.format(root=str(ROOT), work=lines, before=before)
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=timeout_s, check=False)


def test_the_result_of_the_work_comes_back() -> None:
    assert run("return 3").stdout == "3\n"


def test_a_defect_in_the_work_is_shown_and_counts_as_one() -> None:
    done = run("raise ValueError('a defect')")
    assert done.stdout == "1\n"
    assert "ValueError: a defect" in done.stderr


def test_ctrl_c_reaches_the_work_which_ends_in_its_own_way() -> None:
    done = run("""\
try:
    os.kill(os.getppid(), signal.SIGINT)
    time.sleep(30)
except KeyboardInterrupt:
    return 130""")
    assert done.stdout == "130\n"


def test_ctrl_c_before_the_fork_has_returned_reaches_the_work_too() -> None:
    slow_fork = """\
fork = os.fork
def slow():
    child = fork()
    if child:
        time.sleep(0.5)
    return child
os.fork = slow"""
    done = run(
        """\
try:
    os.kill(os.getppid(), signal.SIGINT)
    time.sleep(30)
except KeyboardInterrupt:
    return 130""",
        before=slow_fork,
    )
    assert done.stdout == "130\n"


def test_the_end_of_an_orphan_is_collected(tmp_path: Path) -> None:
    # The child ends at once and leaves a child of its own, whose parent is the keeper from then on. Its end is written
    # down by a third that outlives both: collected processes are in no list.
    watch = """
import os, sys, time
orphan = int(open('{folder}/orphan').read())
while os.path.exists(f'/proc/{{orphan}}'):
    time.sleep(0.01)
open('{folder}/collected', 'w').close()
"""
    folder = str(tmp_path)
    done = run(f"""\
orphan = "import time; time.sleep(0.1)"
leave = f"import subprocess, sys; o = subprocess.Popen([sys.executable, '-c', {{orphan!r}}]); print(o.pid)"
pid = subprocess.run([sys.executable, '-c', leave], capture_output=True, text=True).stdout
open('{folder}/orphan', 'w').write(pid)
watch = subprocess.Popen([sys.executable, '-c', {watch.format(folder=folder)!r}])
return 0""")
    assert done.stdout == "0\n"
    assert (tmp_path / "collected").exists()
