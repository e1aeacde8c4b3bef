"""``mc-nested train --games`` and ``train serve``, in separate processes, over a real scheduler."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli import games_at_play, serve
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import load_preset
from mc_nested.learn.runs.checkpoint import FILE
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.job_task import own_versions
from mc_nested.workers.cluster.keys import make_keys
from mc_nested.workers.games import dask_games
from mc_nested.workers.games import mailbox as mailboxes
from mc_nested.workers.games.dask_games import Answered, DaskGames, GameEvent
from mc_nested.workers.games.game_server import GameServer, OpenGame
from mc_nested.workers.games.game_worker import GameWorker
from mc_nested.workers.games.mailbox import GameAnswer, GameSetup, Mailbox
from sim.virtual_games import VirtualPlay, open_virtual_games
from tests.cli.running import check_mistake, run, table
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT, scenario_text
from tests.workers.cluster.dask_programs import scheduler, tls_words

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


TRAIN = ["train", "--backend", "virtual", "--preset", "model-based", "--stop-at-optimum", "--seed", "3"]


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with scheduler(tmp_path_factory.mktemp("scheduler")) as address:
        yield address


@pytest.fixture(autouse=True)
def own_mailbox(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give each test a new mailbox: a closed one stays closed."""
    made = Mailbox()
    for module in (mailboxes, serve):
        monkeypatch.setattr(module, "process_mailbox", made)


@pytest.fixture
def design(tmp_path: Path) -> Path:
    (tmp_path / "dot.toml").write_text(scenario_text(DOT), "utf-8")
    return tmp_path / "dot.toml"


class Served:
    """Games that are served, and their logs."""

    def __init__(self, url: str, folder: Path, stack: ExitStack) -> None:
        self._url = url
        self._folder = folder
        self._stack = stack

    def begin(self, name: str, *words: str) -> subprocess.Popen[bytes]:
        program = [sys.executable, "-m", "mc_nested.cli", "train", "serve", "--scheduler", self._url, "--name", name]
        with (self._folder / f"{name}.log").open("wb") as log:
            game = subprocess.Popen([*program, *(words or ("--backend", "virtual"))], stdout=log, stderr=log)
        self._stack.callback(game.wait)
        self._stack.callback(game.kill)
        return game

    def said(self, name: str) -> str:
        return (self._folder / f"{name}.log").read_text("utf-8")


@pytest.fixture
def served(url: str, tmp_path: Path) -> Iterator[Served]:
    with ExitStack() as stack:
        yield Served(url, tmp_path, stack)


def begun_beside(served: Served, words: list[str], until: str = "episode") -> subprocess.Popen[str]:
    """Begin a training in a new process, and wait until the game named one says these words."""
    training = subprocess.Popen([sys.executable, "-m", "mc_nested.cli", *words], stderr=subprocess.PIPE, text=True)
    while training.poll() is None and until not in served.said("one"):
        time.sleep(0.05)
    return training


def serve_here(url: str, is_over: threading.Event) -> threading.Thread:
    """Serve a game on the virtual client in a thread of this process, until the event is set."""

    @contextmanager
    def opens(order: GameSetup) -> Iterator[OpenGame]:
        with open_virtual_games([order.scenario], order.seed) as (game,):
            yield OpenGame(ArenaVectorEnv([ArenaEnv(game, order.scenario)]), VirtualPlay([game]), lambda: True)

    def serve() -> None:
        with GameWorker(SchedulerAddress(url, None), "here", lambda _: None):
            GameServer(mailboxes.process_mailbox, opens, lambda _: None, is_over.is_set).serve()

    thread = threading.Thread(target=serve)
    thread.start()
    return thread


def test_training_played_by_a_served_game_reaches_the_optimum_and_writes_summary_and_map(
    url: str, design: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    over = threading.Event()
    thread = serve_here(url, over)
    out = tmp_path / "out"
    try:
        words = [*TRAIN, "--scenario", str(design), "--games", url, "--out", str(out), "--json"]
        assert run(*words) == 0
        assert run("train", "--resume", out, "--games", url) == 0
    finally:
        over.set()
        thread.join()
    printed = capsys.readouterr()
    summary = json.loads(printed.out.splitlines()[0])
    assert summary["final_scores"] == [DOT.optimum]
    assert summary["live"]["game_s"][0] > 0
    assert "here has joined" in printed.err
    assert (out / "map.png").is_file()


def test_a_game_is_served_until_its_player_ends_it(url: str, capsys: pytest.CaptureFixture[str]) -> None:
    order = GameSetup("virtual", DOT, "nested", load_preset("model-based"), 3)
    trainer = GamesTrainer(DOT, order.new_agent(), order.preset, 3)
    came: list[GameAnswer] = []

    def learn() -> None:
        try:
            with connected(SchedulerAddress(url, None)) as client, DaskGames(client, order) as games:
                events: list[GameEvent] = []
                while not events:
                    events = games.events(0.1)
                games.ask("mine", trainer.plan("mine"))
                while not came:
                    answers = [each.answer for each in games.events(0.1) if isinstance(each, Answered)]
                    came.extend(each for each in answers if isinstance(each, GameAnswer))
        finally:
            os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=learn)
    thread.start()
    assert run("train", "serve", "--scheduler", url, "--backend", "virtual", "--name", "mine") == 130
    thread.join()
    (answer,) = came
    assert answer.episode
    assert trainer.take(answer.episode)
    printed = capsys.readouterr()
    assert printed.out.splitlines()[:2] == [f"mine has joined {url}", "episode 1 of dot"]
    assert printed.err == "mc-nested: stopped: no key is held, and the learner goes on without this game\n"


@pytest.mark.slow
def test_one_served_game_learns_exactly_what_train_learns_alone(
    url: str, served: Served, design: Path, tmp_path: Path
) -> None:
    alone, together = tmp_path / "alone", tmp_path / "together"
    words = [*TRAIN, "--scenario", str(design)]
    assert run(*words, "--out", alone) == 0
    game = served.begin("one")
    assert run(*words, "--games", url, "--out", together) == 0
    for name in ("episodes.csv", "evaluations.csv"):
        assert (together / name).read_bytes() == (alone / name).read_bytes()
    with (
        np.load(alone / "checkpoint" / FILE) as ours,
        np.load(together / "checkpoint" / FILE) as its,
    ):
        assert all((ours[name] == its[name]).all() for name in ours.files if name.startswith("policies."))
    game.send_signal(signal.SIGINT)
    assert game.wait(20) == 130
    assert served.said("one").splitlines()[-1].endswith("no key is held, and the learner goes on without this game")


@pytest.mark.slow
def test_training_with_two_games_ends_well_after_one_is_killed(
    url: str, served: Served, design: Path, tmp_path: Path
) -> None:
    games = [served.begin(name) for name in ("one", "two")]
    out = tmp_path / "out"
    words = [*TRAIN, "--scenario", str(design), "--games", url, "--out", str(out)]
    training = begun_beside(served, words)
    games[0].kill()
    _, said = training.communicate(timeout=120)
    assert training.returncode == 0, said
    assert "one is gone" in said
    episodes = [int(row["episode"]) for row in table(out / "episodes.csv")]
    assert episodes == list(range(1, len(episodes) + 1))


@pytest.mark.slow
def test_game_of_another_backend_is_refused_with_the_reason_at_both_ends(
    url: str, served: Served, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    game = served.begin("one")
    assert run("train", "--backend", "live", "--preset", "model-based", "--games", url, "--out", tmp_path / "out") == 2
    says = "the learner asks for --backend live, and this game is virtual"
    assert f"mc-nested: one can't play: {says}; saved: go on with" in capsys.readouterr().err
    assert game.wait(20) == 2
    assert served.said("one").splitlines()[-1] == f"mc-nested: {says}"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["train", "--games", "127.0.0.1:PORT", "--out", "NEW"], "--games are live, or on the virtual client"),
        (
            [*TRAIN, "--games", "127.0.0.1:PORT", "--out", "NEW"],
            "no scheduler answered at tcp://127.0.0.1:PORT: start one there",
        ),
        ([*TRAIN, "--games", "10.0.0.1", "--out", "NEW"], "needs this machine's keys"),
        ([*TRAIN, "--games", "tcp://10.0.0.1", "--out", "NEW"], "is not encrypted"),
        ([*TRAIN, "--games", "127.0.0.1", "--profile", "x", "--out", "NEW"], "leave out --profile"),
        ([*TRAIN, "--games", "127.0.0.1", "--record", "all", "--out", "NEW"], "leave out --record"),
        ([*TRAIN, "--games", "127.0.0.1", "--trials", "2", "--out", "NEW"], "games teach one trial together"),
        ([*TRAIN, "--insecure", "--out", "NEW"], "name their scheduler with --games"),
        ([*TRAIN, "--preset", "tuned", "--games", "127.0.0.1", "--out", "NEW"], "[excursions] need the learner"),
        (["train", "serve", "--scheduler", "127.0.0.1:PORT", "--backend", "virtual"], "no scheduler answered at"),
        (["train", "serve", "--scheduler", "10.0.0.1", "--backend", "virtual"], "needs this machine's keys"),
        (["train", "serve", "--scheduler", "127.0.0.1:PORT", "--profile", "nobody"], "nobody"),
        (["train", "serve", "--scheduler", "127.0.0.1:PORT", "--backend", "sim"], "the simulator needs no game"),
    ],
)
def test_mistake_is_refused_in_one_line_and_nothing_is_written(
    words: list[str],
    says: str,
    nobodys_port: str,
    trained: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = [word.replace("PORT", nobodys_port) for word in words]
    check_mistake(words, says.replace("PORT", nobodys_port), trained, tmp_path, capsys)


@pytest.mark.slow
def test_second_game_of_the_same_name_is_refused_at_both_ends(
    url: str, served: Served, design: Path, tmp_path: Path
) -> None:
    served.begin("one")
    words = [*TRAIN, "--scenario", str(design), "--games", url, "--out", str(tmp_path / "out"), "--episodes", "1000"]
    words.remove("--stop-at-optimum")
    training = begun_beside(served, words)
    log = tmp_path / "second.log"
    program = [sys.executable, "-m", "mc_nested.cli", "train", "serve", "--scheduler", url, "--name", "one"]
    with log.open("wb") as file:
        assert subprocess.run([*program, "--backend", "virtual"], stderr=file, check=False).returncode == 2
    assert log.read_text("utf-8") == f"mc-nested: another game at {url} is named one: give this one another --name\n"
    time.sleep(1)
    training.send_signal(signal.SIGINT)
    _, said = training.communicate(timeout=60)
    assert training.returncode == 130
    assert "a second game named one was refused: give it another --name" in said


@pytest.mark.slow
def test_training_with_keys_runs_over_tls(design: Path, tmp_path: Path) -> None:
    keys = tmp_path / "keys"
    make_keys(keys, ["learner", "pc"])
    with scheduler(tmp_path, *tls_words(keys / "learner")) as secured, ExitStack() as stack:
        assert secured.startswith("tls://")
        served = Served(secured, tmp_path, stack)
        served.begin("pc", "--backend", "virtual", "--keys", str(keys / "pc"))
        words = [*TRAIN, "--scenario", str(design), "--games", secured, "--keys", str(keys / "learner")]
        assert run(*words, "--out", tmp_path / "out") == 0


@pytest.mark.slow
def test_game_with_other_versions_leaves_and_both_ends_name_the_difference(
    url: str, served: Served, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    game = served.begin("one")
    monkeypatch.setattr(dask_games, "own_versions", lambda: {**own_versions(), "numba": "0.1"})
    assert run(*TRAIN, "--games", url, "--out", tmp_path / "out") == 2
    differs = f"one has numba {own_versions()['numba']} instead of 0.1: install the same on both"
    assert f"one can't play: {differs}" in capsys.readouterr().err
    assert game.wait(20) == 2
    assert served.said("one").splitlines()[-1] == f"mc-nested: {differs}"


@pytest.mark.slow
def test_a_second_training_is_refused_the_games_of_the_first(
    url: str,
    served: Served,
    design: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(games_at_play, "FREED_S", 1.0)
    monkeypatch.setattr(games_at_play, "ASK_AGAIN_S", 0.2)
    words = [*TRAIN, "--scenario", str(design), "--games", url]
    first = subprocess.Popen([sys.executable, "-m", "mc_nested.cli", *words, "--out", str(tmp_path / "first")])
    while not (tmp_path / "first" / "config.toml").exists() and first.poll() is None:
        time.sleep(0.05)
    assert run(*words, "--out", tmp_path / "second") == 2
    said = capsys.readouterr()
    assert f"another training has the games of {url}: wait until it ends, or stop it" in said.err
    assert "another training has the games; if it was killed, they are free within 1 s" in said.out + said.err
    assert not (tmp_path / "second").exists()
    first.send_signal(signal.SIGINT)
    assert first.wait(30) == 130
    served.begin("one")
    assert run(*words, "--out", tmp_path / "third") == 0


@pytest.mark.slow
def test_training_is_saved_if_its_scheduler_is_killed(design: Path, tmp_path: Path) -> None:
    with ExitStack() as stack:
        killed = ExitStack()
        address = killed.enter_context(scheduler(tmp_path))
        served = Served(address, tmp_path, stack)
        served.begin("one")
        words = [*TRAIN, "--scenario", str(design), "--games", address, "--out", str(tmp_path / "out")]
        words.remove("--stop-at-optimum")
        training = begun_beside(served, words, until="episode 2")
        killed.close()
        _, said = training.communicate(timeout=60)
    assert training.returncode == 2
    assert "mc-nested: the scheduler was lost: start it again; saved: go on with mc-nested train --resume" in said
    assert "Traceback" not in said
    assert (tmp_path / "out" / "checkpoint").is_dir()
