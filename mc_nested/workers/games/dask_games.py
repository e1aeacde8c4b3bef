"""The games that have joined a scheduler, as their learner sees them."""

import uuid
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any

from mc_nested.errors import ClusterError
from mc_nested.learn.games.episode import EpisodePlan
from mc_nested.workers.cluster.job_task import GAME
from mc_nested.workers.cluster.versions import own_versions
from mc_nested.workers.games.game_task import ask_game, packed
from mc_nested.workers.games.game_worker import NAMES
from mc_nested.workers.games.order import Answer, GameOrder

if TYPE_CHECKING:  # the cluster extra's
    from distributed import Client

ALL = "all"
"""The topic under which a scheduler tells who comes and goes."""


@dataclass(frozen=True)
class Joined:
    """A game has joined, or come back."""

    game: str


@dataclass(frozen=True)
class Left:
    """A game is gone; whatever it was asked won't be answered."""

    game: str


@dataclass(frozen=True)
class Answered:
    """A game has answered, or ``answer`` is an error that it raised."""

    game: str
    answer: Answer | Exception


@dataclass(frozen=True)
class NameTaken:
    """A second game of that name wanted to join, and was refused."""

    game: str


GameEvent = Joined | Left | Answered | NameTaken


class DaskGames:
    """Asks games for episodes. Use it as a context manager: what is still asked for is withdrawn after the block.

    Args:
        client: a connection to the games' scheduler.
        order: what is played.
    """

    def __init__(self, client: "Client", order: GameOrder) -> None:
        self._client = client
        # Its futures are done once the answer is here; Dask's own, as soon as the game has it, and may lose it again.
        self._executor = client.get_executor(pure=False)
        self._order = order
        self._happened: SimpleQueue[tuple[str, Future[Answer]] | NameTaken | None] = SimpleQueue()
        self._addresses: dict[str, str] = {}
        self._was_away = False
        self._asked: dict[str, Future[Answer]] = {}

    def __enter__(self) -> "DaskGames":
        self._listen()
        return self

    def _listen(self) -> None:
        self._client.subscribe_topic(ALL, self._hear_of_workers)
        self._client.subscribe_topic(NAMES, lambda event: self._happened.put(NameTaken(event[1])))
        self._happened.put(None)

    def __exit__(self, *_: object) -> None:
        with suppress(Exception):  # the scheduler may be gone
            for future in self._asked.values():
                future.cancel()

    def ask(self, game: str, plan: EpisodePlan | None) -> None:
        """Ask a game that is free to play a plan; without one, to say when it is ready for one."""
        future = self._executor.submit(
            ask_game,
            own_versions(),
            packed(self._order, plan),
            workers=[self._addresses[game]],
            resources={GAME: 1},
            allow_other_workers=False,
            key=f"{game}-{uuid.uuid4().hex}",
        )
        self._asked[game] = future
        future.add_done_callback(lambda done: self._happened.put((game, done)))

    def events(self, timeout_s: float) -> list[GameEvent]:
        """What has happened since the last call; waits so long for anything.

        ClusterError if the scheduler is lost for good.
        """
        if lost := self._look_at_the_scheduler():
            return lost
        try:
            heard = [self._happened.get(timeout=timeout_s)]
        except Empty:
            return []
        heard += [self._happened.get_nowait() for _ in range(self._happened.qsize())]
        # What a game that is gone has answered before counts: it was played and confirmed.
        found: list[GameEvent] = [each for each in heard if isinstance(each, NameTaken)]
        answers = [each for each in heard if isinstance(each, tuple) and self._asked.get(each[0]) is each[1]]
        found += [self._answered(game, done) for game, done in answers if not done.cancelled()]
        if found and None in heard:
            # First who has answered: whoever is asked again must not have been replaced meanwhile.
            self._happened.put(None)
            return found
        return found or self._comings_and_goings()

    def _look_at_the_scheduler(self) -> list[GameEvent]:
        """All games are gone for a client that has reconnected by itself: what it had asked for is forgotten."""
        if self._client.status == "closed":
            raise ClusterError("the scheduler was lost: start it again")
        if self._client.status != "running":
            self._was_away = True
            return []
        if not self._was_away:
            return []
        self._was_away = False
        gone: list[GameEvent] = [Left(game) for game in self._addresses]
        self._addresses, self._asked = {}, {}
        self._listen()
        return gone

    def _comings_and_goings(self) -> list[GameEvent]:
        workers = self._client.scheduler_info()["workers"]
        now = {each["name"]: address for address, each in workers.items() if each["resources"].get(GAME)}
        found: list[GameEvent] = []
        for game, address in list(self._addresses.items()):
            if now.get(game) != address:
                del self._addresses[game]
                if asked := self._asked.pop(game, None):
                    asked.cancel()
                found.append(Left(game))
        for game, address in now.items():
            if game not in self._addresses:
                self._addresses[game] = address
                found.append(Joined(game))
        return found

    def _answered(self, game: str, done: Future[Answer]) -> Answered:
        del self._asked[game]
        error = done.exception()
        return Answered(game, error if isinstance(error, Exception) else done.result())

    def _hear_of_workers(self, event: tuple[float, dict[str, Any]]) -> None:
        if event[1].get("action") in ("add-worker", "remove-worker"):
            self._happened.put(None)
