"""Measures what the live view costs: actions in a rehearsal window, by turns viewed in a terminal and not.

    python scripts/bench_view.py [--rounds 6] [--actions 40] [--json]

The view is a process of its own in a pseudo-terminal of 80 x 24 that is resized to 200 x 60 half-way. Its share of a
core is that of its whole life, without the two seconds in which it starts. Linux, on a display of its own; the same
computer draws without a graphics card. Run nothing beside it. Exit code 1 if a target was missed.
"""

import argparse
import contextlib
import fcntl
import json
import os
import pty
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.console import Console

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.live.input.signals import signals_as_exit
from scripts.bench_rehearsal import prepare
from scripts.rehearsal_window import ROOT, mc_nested, open_rehearsal
from scripts.window_display import open_display

MOST_CORE, MOST_SLOWER = 0.08, 0.02
SMALL, LARGE = (80, 24), (200, 60)
STARTS_S = 2.0
LIMIT_S = 1800.0
TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")


def main() -> int:
    """Measure in a window of its own, or, with ``--profile``, in the one that is open on this display."""
    parser = argparse.ArgumentParser(description="What the live view costs.")
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--actions", type=int, default=40, help="in each half of a round")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--profile", help=argparse.SUPPRESS)
    parser.add_argument("--truth", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.profile:
        print(json.dumps(_in_turns(options.profile, options.truth, options.rounds, options.actions)))
        return 0
    if not prepare("bench_view", _say):
        return 2
    figures = _in_a_window(options.rounds, options.actions)
    if options.json:
        print(json.dumps(figures))
    else:
        Console().print(figures)
    is_right = figures["slower"] <= MOST_SLOWER and max(figures["core"].values()) <= MOST_CORE
    return 0 if is_right and not figures["wrong"] else 1


def _in_a_window(rounds: int, actions: int) -> dict[str, Any]:
    """Calibrate and play on a display of its own."""
    with (
        signals_as_exit(),
        tempfile.TemporaryDirectory(prefix="mc-nested-view-") as temporary,
        open_display() as env,
        open_rehearsal(env, Path(temporary), "--fps", "60") as window,
    ):
        profile = Path(temporary) / "profile.toml"
        mc_nested(
            *("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, "--record", "off"), env=env
        )
        command = [sys.executable, __file__, "--profile", str(profile), "--truth", str(window.truth_file)]
        command += ["--rounds", str(rounds), "--actions", str(actions)]
        done = subprocess.run(  # noqa: S603 - our own
            command, env={**env, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=LIMIT_S, check=False
        )
        if not done.stdout:
            raise RuntimeError(done.stderr or "nothing was said")
        figures: dict[str, Any] = json.loads(done.stdout)
        return figures


def _in_turns(profile: str, truth_file: Path, rounds: int, actions: int) -> dict[str, Any]:
    """Play by turns with a view and without, each half of a round in the same order of actions."""
    from mc_nested.arena.scenario_file import load_scenario
    from mc_nested.live.profile.store import load_profile
    from mc_nested.live.session import open_live_game
    from mc_nested.view.board import Board
    from mc_nested.view.publisher import Publisher
    from mc_nested.view.status import ArenaSeen
    from scripts.bench_standin import play
    from scripts.rehearsal_window import RehearsalTruth

    scenario = load_scenario("diamond")
    truth = RehearsalTruth(truth_file, load_profile(profile).marked_arena())
    seconds: dict[bool, list[float]] = {False: [], True: []}
    shares = _Shares()
    wrong = 0
    for number in range(rounds):
        for is_viewed in (number % 2 == 0, number % 2 == 1):
            board = Board("bench", "actions in a rehearsal window")
            board.show(arena=ArenaSeen.of(scenario))
            with (
                tempfile.TemporaryDirectory() as folder,
                Publisher(board, Path(folder)) if is_viewed else contextlib.nullcontext(),
                _viewed(Path(folder), shares) if is_viewed else contextlib.nullcontext(),
                open_live_game(scenario, profile, _say, journal=board if is_viewed else None) as (game, _),
            ):
                played = play(game, scenario, truth, actions, number)
                seconds[is_viewed] += game.log.seconds
            wrong += played.wrong_cells + played.wrong_blocks
    plain, viewed = seconds[False], seconds[True]
    return {
        "actions": len(plain) + len(viewed),
        "wrong": wrong,
        "median_s": {"plain": statistics.median(plain), "viewed": statistics.median(viewed)},
        "mean_s": {"plain": statistics.fmean(plain), "viewed": statistics.fmean(viewed)},
        "slower": statistics.median(viewed) / statistics.median(plain) - 1,
        "core": {f"{columns}x{lines}": shares.of((columns, lines)) for columns, lines in (SMALL, LARGE)},
    }


@dataclass
class _Shares:
    """Seconds of a processor and of the clock that views took, by the size of their terminal."""

    spent: dict[tuple[int, int], list[tuple[float, float]]] = field(default_factory=dict)

    def of(self, size: tuple[int, int]) -> float:
        taken = self.spent.get(size, [])
        return sum(busy for busy, _ in taken) / max(1e-9, sum(lasted for _, lasted in taken))


@contextmanager
def _viewed(folder: Path, shares: _Shares) -> Iterator[None]:
    """The view of the run in that folder while the block lasts: first in a small terminal, then in a large one."""
    master, slave = pty.openpty()
    _resize(slave, SMALL)
    command = [sys.executable, "-m", "mc_nested.cli", "view", str(folder)]
    env = {**os.environ, "TERM": "xterm-256color", "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave, env=env, start_new_session=True)  # noqa: S603 - our own
    os.close(slave)
    over = threading.Event()
    watch = threading.Thread(target=_watch, args=(process.pid, master, shares, over))
    watch.start()
    try:
        yield
    finally:
        over.set()
        watch.join()
        process.terminate()
        process.wait()
        os.close(master)


def _watch(process: int, master: int, shares: _Shares, over: threading.Event) -> None:
    """Take what the view draws, resize its terminal after a few seconds, and note what it spends."""
    os.set_blocking(master, False)
    begun = time.monotonic()
    size, since = SMALL, None
    while not over.wait(0.1):
        with contextlib.suppress(BlockingIOError, OSError):
            while os.read(master, 65536):
                pass
        now = time.monotonic()
        if since is None:
            if now - begun >= STARTS_S:
                since = now, _busy_s(process)
        elif size == SMALL and now - since[0] >= 4 * STARTS_S:
            _note(shares, size, since, process)
            size, since = LARGE, (time.monotonic(), _busy_s(process))
            _resize(master, size)
            os.kill(process, signal.SIGWINCH)
    if since is not None:
        _note(shares, size, since, process)


def _note(shares: _Shares, size: tuple[int, int], since: tuple[float, float], process: int) -> None:
    at, busy = since
    shares.spent.setdefault(size, []).append((_busy_s(process) - busy, time.monotonic() - at))


def _busy_s(process: int) -> float:
    """Seconds that a process spent on a processor (proc(5): utime, stime)."""
    fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_A_SECOND


def _resize(terminal: int, size: tuple[int, int]) -> None:
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", size[1], size[0], 0, 0))


def _say(line: str) -> None:
    print(line, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
