"""What a learner asks of a game, what the game answers, and the mailbox between Dask's thread and the main thread.

Dask's thread compares versions, leaves a request and waits; the main thread, which owns the game, takes it and answers.
Signals, the panic key and everything that releases keys belong to the main thread.
"""

import pickle
from collections.abc import Callable, Mapping
from concurrent.futures import Future, wait
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from threading import Event
from typing import Any, NamedTuple

from mc_nested.arena.scenario import Scenario
from mc_nested.errors import ClusterError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.preset import Preset
from mc_nested.workers.cluster.job_task import Versions, differences, own_versions, wanted_here


@dataclass(frozen=True)
class GameSetup:
    """What is played for a training: in which kind of game, what is built, and by whom.

    Args:
        backend: live, or virtual for games on the virtual client.
        scenario: what is built.
        agent: the agent's name.
        preset: its hyper-parameters.
        seed: the training's.
    """

    backend: str
    scenario: Scenario
    agent: str
    preset: Preset
    seed: int

    def new_agent(self) -> Agent:
        """Return an agent of one run, to play with the networks that a plan brings."""
        return Agent(AGENT_SPECS[self.agent], [self.scenario], self.preset, self.seed)


class GameAnswer(NamedTuple):
    """What came of a request.

    Args:
        episode: as it was played and confirmed; None where none was asked for, or it came to nothing.
        problem: why it came to nothing, in a line; empty where it didn't, or the game stands ready.
        is_refusal: whether this game can't play such a setup at all.
        leaves: whether this game won't play any more.
        log: what playing took so far, for a summary.
    """

    episode: PlayedEpisode | None = None
    problem: str = ""
    is_refusal: bool = False
    leaves: bool = False
    log: Mapping[str, Any] = {}


LOOK_EVERY_S = 0.2

CLOSED = GameAnswer(problem="the game was closed", leaves=True)


@dataclass(frozen=True)
class Request:
    """What is asked: to play a plan; without one, to be ready for one.

    ``is_wanted`` says whether anybody still waits for the answer.
    """

    setup: GameSetup
    plan: EpisodePlan | None
    is_wanted: Callable[[], bool]
    answer: Future[GameAnswer] = field(default_factory=Future)


class Mailbox:
    """Requests in one direction, answers in the other; one at a time."""

    def __init__(self) -> None:
        self._requests: SimpleQueue[Request] = SimpleQueue()
        self._closed = Event()
        self._refusal: ClusterError | None = None

    def ask(self, setup: GameSetup, plan: EpisodePlan | None, is_wanted: Callable[[], bool]) -> GameAnswer:
        """Leave a request, and wait for its answer. Dask's thread calls this."""
        request = Request(setup, plan, is_wanted)
        self._requests.put(request)
        while not (self._closed.is_set() or wait([request.answer], LOOK_EVERY_S).done):
            pass
        return request.answer.result() if request.answer.done() else CLOSED

    def refuse(self, error: ClusterError) -> None:
        """Let the main thread end with that error; from Dask's thread."""
        self._refusal = error

    def next(self) -> Request | None:
        """Return the next request, None if there is none for a moment.

        The main thread asks. ClusterError after ``refuse``.
        """
        if self._refusal:
            raise self._refusal
        try:
            return self._requests.get(timeout=LOOK_EVERY_S)
        except Empty:
            return None

    def wait(self) -> None:
        """Wait for a moment, or until it is closed; from the main thread."""
        self._closed.wait(LOOK_EVERY_S)

    def close(self) -> None:
        """Answer whoever asks, now and later, that the game was closed."""
        self._closed.set()


process_mailbox = Mailbox()
"""The mailbox of this process, which serves one game at most."""


def packed(setup: GameSetup, plan: EpisodePlan | None) -> bytes:
    """Return a request, for ``ask_game``."""
    return pickle.dumps((setup, plan))


def ask_game(versions: Versions, package: bytes) -> GameAnswer:
    """Let this process's game play a packed request; the answer. ClusterError if the versions aren't those."""
    from distributed import get_worker

    worker = get_worker()
    if differing := differences(versions, own_versions()):
        error = ClusterError(f"{worker.name} has {differing}: install the same on both")
        process_mailbox.refuse(error)
        raise error
    setup, plan = pickle.loads(package)  # noqa: S301 - from the learner, which the scheduler has let in
    return process_mailbox.ask(setup, plan, wanted_here(worker))
