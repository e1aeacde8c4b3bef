"""One learner, three games on the virtual client: each is killed, and cut off from the network, again and again.

    python scripts/bench_lost_games.py --times 20

The games and the learner are processes of their own; each game reaches the scheduler through a proxy, whose sockets are
closed to cut it off. In the end the learner is stopped by Ctrl+C, and its tables are compared with what the games say
that they have played, score by score: nothing is counted that wasn't played, or oftener than it was, and no more is
missing than the learner says that it has lost. Exit code 1 if not. Needs the extra `cluster`.
"""

import argparse
import csv
import random
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from contextlib import ExitStack, suppress
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.cli.interrupt import INTERRUPTED
from scripts.dask_programs import scheduler
from scripts.served_games import JOINS_S, ROOT, ServedGame, command

GAMES = ("one", "two", "three")

BETWEEN_S = (0.5, 1.5)
"""Seconds between two mishaps, at random."""


class Proxy:
    """Passes on what goes to a scheduler, until it is cut: then every socket that it has is closed."""

    def __init__(self, to: str) -> None:
        host, port = to.removeprefix("tcp://").rsplit(":", 1)
        self._to = host, int(port)
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._open: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    @property
    def address(self) -> str:
        """Where it listens."""
        return f"tcp://127.0.0.1:{self._listening.getsockname()[1]}"

    def cut(self) -> None:
        """Close all connections; new ones are let through."""
        connections, self._open = self._open, []
        for each in connections:
            with suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)
            each.close()

    def close(self) -> None:
        """Let nothing through any more."""
        self._listening.close()
        self.cut()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                ours, _ = self._listening.accept()
                theirs = socket.create_connection(self._to)
                self._open += [ours, theirs]
                for ends in ((ours, theirs), (theirs, ours)):
                    threading.Thread(target=_pass_on, args=ends, daemon=True).start()


def _pass_on(heard: socket.socket, said: socket.socket) -> None:
    with suppress(OSError):
        while heard_of := heard.recv(65536):
            said.sendall(heard_of)
    for each in (heard, said):
        with suppress(OSError):
            each.shutdown(socket.SHUT_RDWR)


class LostGame:
    """A served game, and the proxy that it reaches its scheduler through."""

    def __init__(self, name: str, url: str, folder: Path) -> None:
        self._proxy = Proxy(url)
        self._game = ServedGame(name, self._proxy.address, folder)

    def mishap(self, *, is_cut: bool) -> None:
        """Wait until it plays, then cut it off, or kill it and start it again."""
        before = len(self._game.said)
        end = time.monotonic() + JOINS_S
        while "episode" not in self._game.said[before:] and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(random.uniform(0.0, 0.5))  # noqa: S311 - no secret
        if is_cut:
            self._proxy.cut()
        else:
            self._game.lose()

    @property
    def scores(self) -> list[str]:
        """Of the whole episodes that it says it has played, before and after it was lost."""
        return re.findall(r"^episode \d+: score (\S+) of", self._game.said, re.MULTILINE)

    def end(self) -> None:
        """End it, as a player does."""
        self._game.end()
        self._proxy.close()


def main() -> int:
    """Play, and say what was lost; 1 if anything was that had been confirmed, or counted twice."""
    parser = argparse.ArgumentParser(description="Games that are lost again and again.")
    parser.add_argument("--times", type=int, default=20, help="that each game is killed, and that each is cut off")
    times = parser.parse_args().times
    with tempfile.TemporaryDirectory() as temporary, ExitStack() as stack:
        folder = Path(temporary)
        url = stack.enter_context(scheduler(folder))
        games = [LostGame(name, url, folder) for name in GAMES]
        for game in games:
            stack.callback(game.end)
        out, log = folder / "run", folder / "learner.log"
        words = ["train", "--backend", "virtual", "--preset", "live", "--episodes", "100000", "--games", url]
        with log.open("wb") as file:
            learner = subprocess.Popen(command(*words, "--out", str(out)), cwd=ROOT, stdout=file, stderr=file)  # noqa: S603
        stack.callback(learner.kill)
        mishaps = [(game, is_cut) for game in games for is_cut in (False, True)] * times
        random.shuffle(mishaps)
        for done, (game, is_cut) in enumerate(mishaps):
            game.mishap(is_cut=is_cut)
            time.sleep(random.uniform(*BETWEEN_S))  # noqa: S311 - no secret
            if learner.poll() is not None:
                print(f"the learner ended after {done} mishaps: {log.read_text('utf-8')[-400:]}")
                return 1
        learner.send_signal(signal.SIGINT)
        code = learner.wait(120)
        lost = log.read_text("utf-8").count("its episode is lost")
        for game in games:
            game.end()
        played = Counter(score for game in games for score in game.scores)
        wrong = judged(counted_in(out), played, lost, code)
        print(
            f"{len(mishaps)} mishaps, half of them kills: {played.total()} whole episodes played, "
            f"{counted_in(out).total()} counted, {lost} lost; the learner's exit code {code}"
        )
        print("\n".join(wrong) or "nothing is wrong")
        return 1 if wrong else 0


def counted_in(out: Path) -> Counter[str]:
    """The scores in a training's tables, which have a row for each episode that counted."""
    tables = [(out / name).read_text("utf-8").splitlines() for name in ("episodes.csv", "evaluations.csv")]
    return Counter(f"{float(row['score']):g}" for table in tables for row in csv.DictReader(table))


def judged(counted: Counter[str], played: Counter[str], lost: int, code: int) -> list[str]:
    """What is wrong with what was counted, in lines; the last episode of each game may have ended too late."""
    wrong = []
    if never := counted - played:
        wrong.append(f"counted, but never played, or counted twice: scores {dict(never)}")
    if (missing := (played - counted).total()) > lost + len(GAMES):
        wrong.append(f"{missing} whole episodes are missing, and the learner has lost {lost}")
    if code != INTERRUPTED or not counted:
        wrong.append(f"the learner ended with exit code {code}, and {counted.total()} episodes")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
