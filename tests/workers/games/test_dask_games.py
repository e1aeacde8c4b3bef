"""Games that join a real scheduler, as their learner sees them come, answer and go."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import distributed
import pytest
from distributed import Client

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster import connection
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.dask_jobs import DaskJobs, workers_that_train
from mc_nested.workers.cluster.job_task import own_versions
from mc_nested.workers.games import dask_games, game_worker
from mc_nested.workers.games import mailbox as mailboxes
from mc_nested.workers.games.dask_games import Answered, DaskGames, GameEvent, Joined, Left, NameTaken, Unreachable
from mc_nested.workers.games.game_worker import LOST, GameWorker
from mc_nested.workers.games.mailbox import GameAnswer, Mailbox, Request
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT, one_job
from tests.workers.cluster.dask_programs import scheduler, worker
from tests.workers.games.made_setups import SETUP, new_trainer
from tests.workers.games.proxy import Proxy

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


PATIENCE_S = 60.0


@pytest.fixture(autouse=True)
def hasty(monkeypatch: pytest.MonkeyPatch) -> None:
    """Shorten all waits of games and learners: for an answer's fetching, a look, a scheduler."""
    monkeypatch.setattr(game_worker, "FETCHED_S", 0.5)
    monkeypatch.setattr(game_worker, "TRY_AGAIN_S", 0.2)
    monkeypatch.setattr(game_worker, "CONNECT_S", 2.0)
    monkeypatch.setattr(dask_games, "LOOK_EVERY_S", 0.3)


def until_so(happened: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not happened():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SchedulerAddress]:
    with scheduler(tmp_path_factory.mktemp("scheduler")) as url:
        yield SchedulerAddress(url, None)


@pytest.fixture
def client(address: SchedulerAddress) -> Iterator[Client]:
    with connected(address) as made:
        yield made


@pytest.fixture
def mailbox(monkeypatch: pytest.MonkeyPatch) -> Iterator[Mailbox]:
    made = Mailbox()
    monkeypatch.setattr(mailboxes, "process_mailbox", made)
    yield made
    made.close()


def until(games: DaskGames, count: int) -> list[GameEvent]:
    """Return the next so many events."""
    events: list[GameEvent] = []
    end = time.monotonic() + PATIENCE_S
    while len(events) < count and time.monotonic() < end:
        events += games.events(0.1)
    return events


def next_request(mailbox: Mailbox) -> Request:
    while not (request := mailbox.next()):  # which waits for one itself
        pass
    return request


def first_request(games: DaskGames, mailbox: Mailbox) -> Request:
    """Return what the game asks for that joins and is asked whether it is ready."""
    assert until(games, 1) == [Joined("one")]
    games.ask("one", None)
    return next_request(mailbox)


def listening() -> set[tuple[str, int]]:
    """Return the addresses and ports on which this process listens."""
    psutil = pytest.importorskip("psutil")
    return {tuple(each.laddr) for each in psutil.Process().net_connections() if each.status == "LISTEN"}


def quiet(_: str) -> None:
    pass


def test_game_joins_answers_a_request_and_leaves(address: SchedulerAddress, client: Client, mailbox: Mailbox) -> None:
    plan = new_trainer().plan("one")
    with DaskGames(client, SETUP) as games:
        assert games.events(0.5) == []
        with GameWorker(address, "one", quiet):
            assert until(games, 1) == [Joined("one")]
            games.ask("one", plan)
            request = next_request(mailbox)
            assert request.setup == SETUP
            assert request.plan
            assert request.plan.online.tobytes() == plan.online.tobytes()
            assert request.is_wanted()
            answer = GameAnswer(problem="a mishap", log={"game_s": [1.5]})
            request.answer.set_result(answer)
            assert until(games, 1) == [Answered("one", answer)]
        assert until(games, 1) == [Left("one")]


def test_a_second_game_of_that_name_is_refused_and_the_first_stays(address: SchedulerAddress, client: Client) -> None:
    said: list[str] = []
    with DaskGames(client, SETUP) as games, GameWorker(address, "one", said.append):
        assert until(games, 1) == [Joined("one")]
        with pytest.raises(ClusterError, match="is named one: give this one another --name"):
            GameWorker(address, "one", said.append).__enter__()
        assert until(games, 1) == [NameTaken("one")]
        assert games.events(0.3) == []
    assert said == [f"one has joined {address.url}"]


def test_game_cut_off_from_its_network_joins_again_and_drops_its_episode(
    address: SchedulerAddress, client: Client, mailbox: Mailbox
) -> None:
    proxy = Proxy(address.url)
    said: list[str] = []
    with DaskGames(client, SETUP) as games, GameWorker(SchedulerAddress(proxy.address, None), "one", said.append):
        request = first_request(games, mailbox)
        proxy.cut()
        assert until(games, 1) == [Left("one")]
        until_so(lambda: not request.is_wanted())
        request.answer.set_result(GameAnswer(problem="too late"))
        assert until(games, 1) == [Joined("one")]
        assert games.events(0.3) == []
    assert said[1] == LOST
    proxy.close()


def test_answer_of_a_game_that_left_afterwards_is_reported_before_its_leaving(
    address: SchedulerAddress, client: Client, mailbox: Mailbox
) -> None:
    with DaskGames(client, SETUP) as games:
        with GameWorker(address, "one", quiet):
            first_request(games, mailbox).answer.set_result(GameAnswer())
        assert games.events(PATIENCE_S) == [Answered("one", GameAnswer())]
        games.ask("one", None)
        assert games.events(1.0) == [Left("one")]


@pytest.mark.parametrize("looks", [True, False], ids=["while it looks", "while it doesn't look"])
def test_learner_cut_off_from_its_network_sees_its_games_join_again(
    looks: bool, address: SchedulerAddress, mailbox: Mailbox
) -> None:
    proxy = Proxy(address.url)
    with ExitStack() as stack:
        stack.callback(proxy.close)
        stack.enter_context(GameWorker(address, "one", quiet))
        client = stack.enter_context(connected(SchedulerAddress(proxy.address, None)))
        games = stack.enter_context(DaskGames(client, SETUP))
        request = first_request(games, mailbox)
        before = client.scheduler_comm
        proxy.cut()
        if not looks:  # and in the meantime Dask has connected it again
            until_so(lambda: client.status == "running" and client.scheduler_comm not in (before, None))
        assert until(games, 2) == [Left("one"), Joined("one")]
        assert not request.is_wanted()
        request.answer.set_result(GameAnswer(problem="too late"))
        games.ask("one", None)
        next_request(mailbox).answer.set_result(GameAnswer())
        assert until(games, 1) == [Answered("one", GameAnswer())]


def test_answer_that_arrived_before_the_scheduler_was_lost_is_reported(
    tmp_path: Path, mailbox: Mailbox, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 1.0)
    with ExitStack() as stack:
        killed = ExitStack()
        address = SchedulerAddress(killed.enter_context(scheduler(tmp_path)), None)
        client = stack.enter_context(connected(address))
        stack.enter_context(GameWorker(address, "one", quiet))
        games = stack.enter_context(DaskGames(client, SETUP))
        first_request(games, mailbox).answer.set_result(GameAnswer())
        until_so(games._asked["one"].done)
        killed.close()
        until_so(lambda: bool(client.status == "closed"))
        assert games.events(0.1) == [Answered("one", GameAnswer())]
        with pytest.raises(ClusterError, match=r"^the scheduler was lost"):
            games.events(0.1)


def test_answer_that_cannot_be_fetched_is_reported_once(
    address: SchedulerAddress, client: Client, mailbox: Mailbox, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_games, "FETCHED_S", 0.5)
    nobody = "tcp://127.0.0.1:9"
    monkeypatch.setattr(distributed, "Worker", partial(distributed.Worker, contact_address=nobody))
    with DaskGames(client, SETUP) as games:
        with GameWorker(address, "one", quiet):
            first_request(games, mailbox).answer.set_result(GameAnswer())
            assert until(games, 1) == [Unreachable("one", nobody)]
            assert games.events(0.5) == []
        assert until(games, 1) == [Left("one")]
        assert games.events(0.5) == []


def test_request_is_no_longer_wanted_once_the_learner_is_done(
    address: SchedulerAddress, client: Client, mailbox: Mailbox
) -> None:
    with GameWorker(address, "one", quiet):
        with DaskGames(client, SETUP) as games:
            request = first_request(games, mailbox)
        until_so(lambda: not request.is_wanted())
        request.answer.set_result(GameAnswer())


def test_a_game_with_other_versions_says_what_differs(
    address: SchedulerAddress, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_games, "own_versions", lambda: {**own_versions(), "numba": "0.1"})
    with DaskGames(client, SETUP) as games, GameWorker(address, "one", quiet):
        assert until(games, 1) == [Joined("one")]
        games.ask("one", None)
        (event,) = until(games, 1)
    assert isinstance(event, Answered)
    assert isinstance(event.answer, ClusterError)
    assert "one has numba" in str(event.answer)
    assert "instead of 0.1" in str(event.answer)


@pytest.mark.skipif(sys.platform != "linux", reason="reads Linux's list of sockets")
def test_a_game_on_loopback_listens_on_loopback_alone(address: SchedulerAddress) -> None:
    before = listening()
    with GameWorker(address, "one", quiet):
        assert listening() - before
        assert {host for host, _ in listening() - before} == {"127.0.0.1"}


@pytest.mark.usefixtures("mailbox")
def test_job_of_an_experiment_does_not_begin_on_a_game(
    address: SchedulerAddress, client: Client, tmp_path: Path
) -> None:
    with GameWorker(address, "one", quiet):
        assert workers_that_train(client) == []
        job = one_job("nested", [DOT], 1)
        executor = DaskJobs(client)
        future = executor.submit(job, tmp_path / "jobs" / job.name)
        time.sleep(0.3)  # in which a game that took it would have begun
        assert not future.running()
        assert not future.done()
        assert executor.reports() == []
        future.cancel()


@pytest.mark.slow
@pytest.mark.usefixtures("mailbox")
def test_job_of_an_experiment_waits_for_a_worker_beside_a_game(
    address: SchedulerAddress, client: Client, tmp_path: Path
) -> None:
    with GameWorker(address, "one", quiet):
        job = one_job("nested", [DOT], 1)
        executor = DaskJobs(client)
        future = executor.submit(job, tmp_path / "jobs" / job.name)
        time.sleep(1.5)
        assert executor.reports() == []
        running = worker(tmp_path, address.url)
        try:
            assert future.result(PATIENCE_S).finished
        finally:
            running.kill()
            running.wait()


@pytest.mark.skipif(sys.platform != "linux", reason="reads Linux's list of sockets")
def test_tries_to_join_again_close_their_ports(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(game_worker, "START_S", 0.5)
    made: list[distributed.Worker] = []

    def made_worker(*arguments: Any, **options: Any) -> distributed.Worker:
        made.append(worker_class(*arguments, **options))
        return made[-1]

    worker_class = distributed.Worker
    with ExitStack() as stack:
        killed = ExitStack()
        url = killed.enter_context(scheduler(tmp_path))
        before = listening()
        stack.enter_context(GameWorker(SchedulerAddress(url, None), "one", quiet))
        killed.close()
        monkeypatch.setattr(distributed, "Worker", made_worker)
        until_so(lambda: len(made) >= 4)
        # The last has its two ports still, and at most one before it is just closing them.
        assert len(listening() - before) <= 4


def test_a_scheduler_that_is_lost_for_good_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 1.0)
    with ExitStack() as stack:
        killed = ExitStack()
        url = killed.enter_context(scheduler(tmp_path))
        client = stack.enter_context(connected(SchedulerAddress(url, None)))
        games = stack.enter_context(DaskGames(client, SETUP))
        assert games.events(0.1) == []
        killed.close()
        with pytest.raises(ClusterError, match=r"^the scheduler was lost: start it again$"):
            until(games, 1)


@pytest.mark.skipif(sys.platform == "win32", reason="processes can't be stopped and continued")
def test_learner_does_not_wait_for_a_scheduler_that_hangs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    psutil = pytest.importorskip("psutil")
    monkeypatch.setattr(dask_games, "LOOKS_S", 0.3)
    monkeypatch.setattr(dask_games, "LOOK_EVERY_S", 0.0)
    before = {each.pid for each in psutil.Process().children()}
    with (
        scheduler(tmp_path) as url,
        connected(SchedulerAddress(url, None)) as client,
        DaskGames(client, SETUP) as games,
    ):
        assert games.events(0.1) == []
        (process,) = [each for each in psutil.Process().children() if each.pid not in before]
        process.suspend()
        began = time.monotonic()
        assert [games.events(0.1) for _ in range(3)] == [[], [], []]
        assert time.monotonic() - began < 3.0
        process.resume()
        with GameWorker(SchedulerAddress(url, None), "one", quiet):
            assert until(games, 1) == [Joined("one")]


def test_missing_scheduler_is_an_error_that_leaves_at_most_one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 0.5)
    before = threading.active_count()
    with pytest.raises(ClusterError, match=r"no scheduler answered at tcp://127\.0\.0\.1:9"):
        GameWorker(SchedulerAddress("tcp://127.0.0.1:9", None), "one", quiet).__enter__()
    assert threading.active_count() <= before + 1
