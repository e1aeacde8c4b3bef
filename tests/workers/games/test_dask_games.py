"""Games that join a real scheduler, as their learner sees them come, answer and go."""

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from distributed import Client

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster import connection
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.dask_jobs import DaskJobs, workers_that_train
from mc_nested.workers.cluster.versions import own_versions
from mc_nested.workers.games import dask_games, game_task
from mc_nested.workers.games.dask_games import Answered, DaskGames, GameEvent, Joined, Left, NameTaken
from mc_nested.workers.games.desk import Desk
from mc_nested.workers.games.game_worker import LOST, GameWorker
from mc_nested.workers.games.order import Answer
from scripts.bench_lost_games import Proxy
from scripts.dask_programs import scheduler, worker
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT, one_job
from tests.workers.games.made_orders import ORDER, new_trainer

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


PATIENCE_S = 20.0


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SchedulerAddress]:
    with scheduler(tmp_path_factory.mktemp("scheduler")) as url:
        yield SchedulerAddress(url, None)


@pytest.fixture
def client(address: SchedulerAddress) -> Iterator[Client]:
    with connected(address) as made:
        yield made


@pytest.fixture
def desk(monkeypatch: pytest.MonkeyPatch) -> Iterator[Desk]:
    made = Desk()
    monkeypatch.setattr(game_task, "desk", made)
    yield made
    made.close()


def until(games: DaskGames, count: int) -> list[GameEvent]:
    """The next events, so many."""
    events: list[GameEvent] = []
    end = time.monotonic() + PATIENCE_S
    while len(events) < count and time.monotonic() < end:
        events += games.events(0.1)
    return events


def listening() -> set[tuple[str, int]]:
    """Addresses and ports on which this process listens."""
    psutil = pytest.importorskip("psutil")
    return {tuple(each.laddr) for each in psutil.Process().net_connections() if each.status == "LISTEN"}


def quiet(_: str) -> None:
    pass


def test_games_come_answer_and_go(address: SchedulerAddress, client: Client, desk: Desk) -> None:
    plan = new_trainer().plan("one")
    with DaskGames(client, ORDER) as games:
        assert games.events(0.5) == []
        with GameWorker(address, "one", quiet):
            assert until(games, 1) == [Joined("one")]
            games.ask("one", plan)
            while not (request := desk.next()):
                pass
            assert request.order == ORDER
            assert request.plan
            assert request.plan.online.tobytes() == plan.online.tobytes()
            assert request.is_wanted()
            answer = Answer(problem="a mishap", log={"game_s": [1.5]})
            request.answer.set_result(answer)
            assert until(games, 1) == [Answered("one", answer)]
        assert until(games, 1) == [Left("one")]


def test_a_second_game_of_that_name_is_refused_and_the_first_stays(address: SchedulerAddress, client: Client) -> None:
    said: list[str] = []
    with DaskGames(client, ORDER) as games, GameWorker(address, "one", said.append):
        assert until(games, 1) == [Joined("one")]
        with pytest.raises(ClusterError, match="is named one: give this one another --name"):
            GameWorker(address, "one", said.append).__enter__()
        assert until(games, 1) == [NameTaken("one")]
        assert games.events(0.3) == []
    assert said == [f"one has joined {address.url}"]


def test_a_game_whose_network_is_gone_joins_again_and_breaks_off_what_it_played(
    address: SchedulerAddress, client: Client, desk: Desk
) -> None:
    proxy = Proxy(address.url)
    said: list[str] = []
    with DaskGames(client, ORDER) as games, GameWorker(SchedulerAddress(proxy.address, None), "one", said.append):
        assert until(games, 1) == [Joined("one")]
        games.ask("one", None)
        while not (request := desk.next()):
            pass
        proxy.cut()
        assert until(games, 1) == [Left("one")]
        end = time.monotonic() + PATIENCE_S
        while request.is_wanted() and time.monotonic() < end:
            time.sleep(0.05)
        assert not request.is_wanted()
        request.answer.set_result(Answer(problem="too late"))
        assert until(games, 1) == [Joined("one")]
        assert games.events(0.3) == []
    assert said[1] == LOST
    proxy.close()


def test_an_answer_of_a_game_that_has_left_since_counts_and_is_told_first(
    address: SchedulerAddress, client: Client, desk: Desk
) -> None:
    with DaskGames(client, ORDER) as games:
        with GameWorker(address, "one", quiet):
            assert until(games, 1) == [Joined("one")]
            games.ask("one", None)
            while not (request := desk.next()):
                pass
            request.answer.set_result(Answer())
        time.sleep(0.3)
        assert games.events(0.1) == [Answered("one", Answer())]
        games.ask("one", None)
        assert games.events(1.0) == [Left("one")]


def test_a_learner_that_is_done_wants_no_answer_any_more(address: SchedulerAddress, client: Client, desk: Desk) -> None:
    with GameWorker(address, "one", quiet):
        with DaskGames(client, ORDER) as games:
            assert until(games, 1) == [Joined("one")]
            games.ask("one", None)
            while not (request := desk.next()):
                pass
        end = time.monotonic() + PATIENCE_S
        while request.is_wanted() and time.monotonic() < end:
            time.sleep(0.05)
        assert not request.is_wanted()
        request.answer.set_result(Answer())


def test_a_game_with_other_versions_says_what_differs(
    address: SchedulerAddress, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_games, "own_versions", lambda: {**own_versions(), "numba": "0.1"})
    with DaskGames(client, ORDER) as games, GameWorker(address, "one", quiet):
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


@pytest.mark.usefixtures("desk")
def test_an_experiments_job_leaves_a_game_alone(address: SchedulerAddress, client: Client, tmp_path: Path) -> None:
    with GameWorker(address, "one", quiet):
        assert workers_that_train(client) == []
        job = one_job("nested", [DOT], 1)
        executor = DaskJobs(client)
        future = executor.submit(job, tmp_path / "units" / job.name)
        time.sleep(1.5)
        assert executor.reports() == []
        running = worker(tmp_path, address.url)
        try:
            assert future.result(PATIENCE_S).finished
        finally:
            running.kill()
            running.wait()


def test_a_scheduler_that_is_lost_for_good_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 1.0)
    with ExitStack() as stack:
        killed = ExitStack()
        url = killed.enter_context(scheduler(tmp_path))
        client = stack.enter_context(connected(SchedulerAddress(url, None)))
        games = stack.enter_context(DaskGames(client, ORDER))
        assert games.events(0.1) == []
        killed.close()
        with pytest.raises(ClusterError, match=r"^the scheduler was lost: start it again$"):
            until(games, 1)


def test_no_scheduler_is_one_line_and_leaves_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 0.5)
    before = threading.active_count()
    with pytest.raises(ClusterError, match=r"no scheduler answered at tcp://127\.0\.0\.1:9"):
        GameWorker(SchedulerAddress("tcp://127.0.0.1:9", None), "one", quiet).__enter__()
    assert threading.active_count() <= before + 1
