"""One thread for matrix products while a learner computes, whatever the process allows its other parts.

How a BLAS divides a product among threads changes the order of its sums, and with it the last digits: a training would
depend on the number of cores. And for products this small, a second thread only waits for the first.
"""

import threading
from collections.abc import Callable
from functools import cache, wraps
from typing import ParamSpec, TypeVar

import scipy.linalg.cython_blas  # noqa: F401 - compiled products call its BLAS: it must be loaded to be found
from threadpoolctl import LibController, ThreadpoolController

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")


def on_one_blas_thread(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """The function, during which every BLAS of the process takes one thread; afterwards as many as before.

    Inside another such function it costs next to nothing. Python threads may be inside at the same time.
    """

    @wraps(function)
    def with_one_thread(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Result:
        if _here.inside:
            return function(*args, **kwargs)
        _enter()
        try:
            return function(*args, **kwargs)
        finally:
            _leave()

    return with_one_thread


class _Here(threading.local):
    """Whether this Python thread is inside."""

    inside = False


_here = _Here()
_lock = threading.Lock()
_before: dict[int, int] = {}
"""While any Python thread is inside: the threads that a library took before, by its place among the libraries."""
_threads_inside = 0


@cache
def _libraries() -> list[LibController]:
    found: list[LibController] = ThreadpoolController().select(user_api="blas").lib_controllers
    return found


def _enter() -> None:
    global _threads_inside  # noqa: PLW0603 - how many threads a BLAS takes is a state of the process
    with _lock:
        _threads_inside += 1
        for at, library in enumerate(_libraries()):
            # Asked by each Python thread: for some libraries the number is each one's own.
            if (threads := library.get_num_threads()) != 1:
                _before.setdefault(at, threads)
                _set(library, 1)
    _here.inside = True


def _leave() -> None:
    global _threads_inside  # noqa: PLW0603 - as above
    _here.inside = False
    with _lock:
        _threads_inside -= 1
        if not _threads_inside:
            for at, threads in _before.items():
                _set(_libraries()[at], threads)
            _before.clear()


def _set(library: LibController, threads: int) -> None:
    # From version 3.8 on, threadpoolctl ignores all Python threads but the last that set it; the lock is enough here.
    release = getattr(library, "clear_controlling_thread", None)
    if release:
        release(force=True)
    library.set_num_threads(threads)
    if release:
        release(force=True)
