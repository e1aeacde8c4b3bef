"""The games that have joined a scheduler, as their learner sees them."""

import asyncio
import time
import uuid
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any

from mc_nested.errors import ClusterError
from mc_nested.learn.games.episode import EpisodePlan
from mc_nested.workers.cluster.dask_jobs import ALL
from mc_nested.workers.cluster.job_task import GAME, own_versions
from mc_nested.workers.executor import come_to
from mc_nested.workers.games.game_worker import NAMES
from mc_nested.workers.games.mailbox import GameAnswer, GameSetup, ask_game, packed

if TYPE_CHECKING:  # the cluster extra's
    from distributed import Client

LOOK_EVERY_S = 2.0
"""Seconds between two looks at who is there, where the scheduler doesn't tell."""

LOOKS_S = 5.0
"""Seconds that such a look may take: in them nobody sees a Ctrl+C."""

FETCHED_S = 15.0
"""Seconds after which an answer that isn't fetched from its game counts as unreachable."""

LOST = "the scheduler was lost: start it again"


@dataclass(frozen=True)
class GameEvent:
    """What has happened to the game of that name."""

    game: str


class Joined(GameEvent):
    """It has joined, or come back."""


class Left(GameEvent):
    """It is gone; whatever it was asked won't be answered."""


@dataclass(frozen=True)
class Answered(GameEvent):
    """It has answered, or ``answer`` is an error that it raised."""

    answer: GameAnswer | Exception


class NameTaken(GameEvent):
    """A second game of that name wanted to join, and was refused."""


@dataclass(frozen=True)
class Unreachable(GameEvent):
    """It has answered, and its answer can't be fetched at that address, which a firewall may close."""

    address: str


@dataclass(frozen=True)
class Done(GameEvent):
    """What it was asked is done, or withdrawn."""

    future: Future[GameAnswer]


class DaskGames:
    """Asks games for episodes. Use it as a context manager: what is still asked for is withdrawn after the block.

    Args:
        client: a connection to the games' scheduler.
        setup: what is played.
    """

    def __init__(self, client: "Client", setup: GameSetup) -> None:
        self._client = client
        # Its futures are done once the answer is here; Dask's own, as soon as the game has it, and may lose it again.
        self._executor = client.get_executor(pure=False)
        self._setup = setup
        self._happened: SimpleQueue[Done | NameTaken | None] = SimpleQueue()
        self._addresses: dict[str, str] = {}
        self._asked: dict[str, Future[GameAnswer]] = {}
        self._keys: dict[str, str] = {}
        """Dask's name of what each game was asked last."""
        self._answered_at: dict[str, float | None] = {}
        """Since when answers wait to be fetched; None where that was told."""
        self._was_away = False
        self._look_at = 0.0

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
        """Ask a game that is free to play a plan; without one, to say when it is ready for one.

        ClusterError if the scheduler is lost for good.
        """
        if self._client.status == "closed":
            raise ClusterError(LOST)
        self._keys[game] = f"{game}-{uuid.uuid4().hex}"
        future = self._executor.submit(
            ask_game,
            own_versions(),
            packed(self._setup, plan),
            workers=[self._addresses[game]],
            resources={GAME: 1},
            allow_other_workers=False,
            key=self._keys[game],
        )
        self._asked[game] = future
        future.add_done_callback(lambda done: self._happened.put(Done(game, done)))

    def events(self, timeout_s: float) -> list[GameEvent]:
        """Return what has happened since the last call; waits so long for anything.

        ClusterError if the scheduler is lost for good.
        """
        heard = come_to(self._happened, timeout_s)
        answers = [each for each in heard if isinstance(each, Done) and self._asked.get(each.game) is each.future]
        # Answers come first: they were played and confirmed, whatever has become of the game or the scheduler since.
        found: list[GameEvent] = [NameTaken(each.game) for each in heard if isinstance(each, NameTaken)]
        found += [self._answered(each) for each in answers if not each.future.cancelled()]
        withdrawn = [each for each in answers if each.future.cancelled()]
        if found:
            for later in withdrawn:
                self._happened.put(later)
            if None in heard:
                self._happened.put(None)
            return found
        if self._client.status == "closed":
            raise ClusterError(LOST)
        # Nobody here has withdrawn them: the connection was lost, and with it what was asked, and who is listened to.
        self._was_away = self._was_away or bool(withdrawn) or self._client.status != "running"
        found = [self._forget(each.game) for each in withdrawn]
        return found or self._unreachable() or self._comings_and_goings(is_heard=None in heard)

    def _comings_and_goings(self, *, is_heard: bool) -> list[GameEvent]:
        """Return who has come and gone, if that was heard of, or wasn't looked at for a while."""
        to_scheduler = self._client.scheduler
        is_due = is_heard or time.monotonic() >= self._look_at
        if self._client.status != "running" or not to_scheduler or not is_due:
            return []
        if self._was_away:
            self._was_away = False
            self._listen()
        self._look_at = time.monotonic() + LOOK_EVERY_S
        try:
            known = self._client.sync(to_scheduler.identity, callback_timeout=LOOKS_S)
        except (OSError, asyncio.TimeoutError):  # it is lost just now, which the status will say, or it hangs
            return []
        workers: dict[str, dict[str, Any]] = known["workers"]
        now = {each["name"]: address for address, each in workers.items() if each["resources"].get(GAME)}
        gone = [game for game, address in self._addresses.items() if now.get(game) != address]
        found = [self._forget(game) for game in gone]
        for game, address in now.items():
            if game not in self._addresses:
                self._addresses[game] = address
                found.append(Joined(game))
        return found

    def _forget(self, game: str) -> GameEvent:
        """Forget a game that is gone, or as good as gone: what it was asked is withdrawn."""
        self._addresses.pop(game, None)
        self._answered_at.pop(game, None)
        if asked := self._asked.pop(game, None):
            asked.cancel()
        return Left(game)

    def _unreachable(self) -> list[GameEvent]:
        """Return which games have answered long ago, at addresses that the scheduler can't fetch the answers from."""
        now = time.monotonic()
        for game, future in self._asked.items():
            state = self._client.futures.get(self._keys[game])
            if future.done() or state is None or state.status != "finished":
                self._answered_at.pop(game, None)
            else:
                self._answered_at.setdefault(game, now)
        late = [game for game, since in self._answered_at.items() if since is not None and now - since > FETCHED_S]
        for game in late:
            self._answered_at[game] = None
        return [Unreachable(game, self._addresses[game]) for game in late]

    def _answered(self, done: Done) -> Answered:
        del self._asked[done.game]
        self._answered_at.pop(done.game, None)
        error = done.future.exception()
        return Answered(done.game, error if isinstance(error, Exception) else done.future.result())

    def _hear_of_workers(self, event: tuple[float, dict[str, Any]]) -> None:
        if event[1].get("action") in ("add-worker", "remove-worker"):
            self._happened.put(None)
