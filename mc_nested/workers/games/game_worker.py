"""The Dask worker of a served game, in a thread of this process. It joins again when it has lost its scheduler."""

import asyncio
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from typing import TYPE_CHECKING, Any

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.address import SchedulerAddress, is_local
from mc_nested.workers.cluster.connection import CONNECT_S, connected, security_of, unreachable
from mc_nested.workers.cluster.job_task import GAME

if TYPE_CHECKING:  # the cluster extra's
    from distributed import Worker

START_S = 30.0
"""Seconds that the worker may take to join, on a busy computer."""

NOTICED_S = 60.0
"""Seconds in which a scheduler notices that a game is gone."""

TRY_AGAIN_S = 2.0
"""Seconds between two tries to join again."""

FETCHED_S, LOOK_EVERY_S = 3.0, 0.05
"""Seconds that a learner may take to fetch an answer, and between two looks whether it has."""

NAME_TAKEN = "name taken"
"""What a scheduler says of a second worker of a name."""

LOST = "the scheduler can't be reached: trying again"


NAMES = "mc-nested-names"
"""The topic under which a learner hears the name of a game that was refused, since another has it."""


class NameTakenError(ClusterError):
    """Another game has that name."""


class GameWorker:
    """Joins a scheduler under a name, as a context manager: it has left after the block.

    Args:
        address: the scheduler's.
        name: the game's, which no other may have.
        say: shows a line to the player, when it has joined, and when it has lost the scheduler.

    Raises:
        ClusterError: on entering, if the scheduler can't be reached, or another game has that name.
    """

    def __init__(self, address: SchedulerAddress, name: str, say: Callable[[str], None]) -> None:
        self._address, self._name, self._say = address, name, say
        self._serving: Any = None

    def __enter__(self) -> "GameWorker":
        with connected(self._address):  # which says soon whether it can be reached
            pass
        self._loop = asyncio.new_event_loop()
        self._thread = Thread(target=self._loop.run_forever, name="game-worker", daemon=True)
        self._thread.start()
        self._folder = tempfile.TemporaryDirectory(prefix="mc-nested-", ignore_cleanup_errors=True)
        try:
            worker = asyncio.run_coroutine_threadsafe(self._joined(), self._loop).result()
        except BaseException as error:
            self._end()
            if isinstance(error, NameTakenError):
                self._tell_the_learner()
            raise
        self._serving = asyncio.run_coroutine_threadsafe(self._stay(worker), self._loop)
        return self

    def __exit__(self, *_: object) -> None:
        self._serving.cancel()
        try:
            with suppress(Exception):  # it leaves, whether or not anybody hears of it
                asyncio.run_coroutine_threadsafe(self._leave(), self._loop).result(FETCHED_S + CONNECT_S)
        finally:
            self._end()

    async def _joined(self) -> "Worker":
        """Return a worker that has joined; ClusterError as the class says."""
        from distributed import Worker

        self._worker = Worker(
            self._address.url,
            name=self._name,
            nthreads=1,
            resources={GAME: 1},
            memory_limit=0,  # no limit: the learner's weights are small, and a full worker would be paused
            local_directory=self._folder.name,
            dashboard=False,
            # Dask opens a port for figures about itself, whatever is said of its dashboard: nobody else shall reach it.
            dashboard_address="127.0.0.1:0",
            host="127.0.0.1" if is_local(self._address) else None,
            security=security_of(self._address),
            death_timeout=START_S,  # then it closes what it has opened
        )
        try:
            await asyncio.wait_for(self._worker, START_S + CONNECT_S)
        except (OSError, asyncio.TimeoutError, RuntimeError) as error:
            if NAME_TAKEN in str(error.__cause__):
                raise NameTakenError(
                    f"another game at {self._address.url} is named {self._name}: give this one another --name"
                ) from error
            raise ClusterError(unreachable(self._address)) from error
        self._say(f"{self._name} has joined {self._address.url}")
        return self._worker

    async def _stay(self, worker: "Worker") -> None:
        while True:
            await worker.finished()
            self._say(LOST)
            worker = await self._joined_again()

    async def _joined_again(self) -> "Worker":
        began, is_said = time.monotonic(), False
        while True:
            await asyncio.sleep(TRY_AGAIN_S)
            try:
                return await self._joined()
            except Exception as error:
                # This game's own name counts as taken as long as the scheduler hasn't noticed that it was gone.
                if isinstance(error, NameTakenError) and not is_said and time.monotonic() - began > NOTICED_S:
                    is_said = True
                    self._say(str(error))

    async def _leave(self) -> None:
        """Leave once the learner has fetched the last answer, or no longer comes for it."""
        for _ in range(int(FETCHED_S / LOOK_EVERY_S)):
            if not self._worker.state.tasks:
                break
            await asyncio.sleep(LOOK_EVERY_S)
        await self._worker.close(timeout=CONNECT_S / 2)

    def _tell_the_learner(self) -> None:
        with connected(self._address) as client:
            client.log_event(NAMES, self._name)

    def _end(self) -> None:
        with suppress(Exception):  # what doesn't end in time ends with the process
            asyncio.run_coroutine_threadsafe(_cancel_others(), self._loop).result(CONNECT_S)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(CONNECT_S)
        if not self._thread.is_alive():
            self._loop.close()
        self._folder.cleanup()


async def _cancel_others() -> None:
    """Cancel whatever else this thread's loop has to do, and let it end."""
    others = asyncio.all_tasks() - {asyncio.current_task()}
    for each in others:
        each.cancel()
    await asyncio.gather(*others, return_exceptions=True)
