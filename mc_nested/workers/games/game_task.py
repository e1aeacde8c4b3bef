"""What a game's Dask worker does with a request: compares versions, and leaves it on the desk of its main thread."""

import pickle

from mc_nested.errors import ClusterError
from mc_nested.learn.games.episode import EpisodePlan
from mc_nested.workers.cluster.job_task import wanted_here
from mc_nested.workers.cluster.versions import Versions, differences, own_versions
from mc_nested.workers.games.desk import Desk
from mc_nested.workers.games.order import GameAnswer, GameOrder

desk = Desk()
"""The desk of this process, which serves one game at most."""


def packed(order: GameOrder, plan: EpisodePlan | None) -> bytes:
    """Return a request, for ``ask_game``."""
    return pickle.dumps((order, plan))


def ask_game(versions: Versions, package: bytes) -> GameAnswer:
    """Let this process's game play a packed request; the answer. ClusterError if the versions aren't those."""
    from distributed import get_worker

    worker = get_worker()
    if differing := differences(versions, own_versions()):
        error = ClusterError(f"{worker.name} has {differing}: install the same on both")
        desk.refuse(error)
        raise error
    order, plan = pickle.loads(package)  # noqa: S301 - from the learner, which the scheduler has let in
    return desk.ask(order, plan, wanted_here(worker))
