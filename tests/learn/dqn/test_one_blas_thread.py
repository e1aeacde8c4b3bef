"""A learner computes on one BLAS thread, and leaves the process's number as it was."""

import os
import subprocess
import sys
import threading

import pytest
from threadpoolctl import ThreadpoolController, threadpool_limits

from mc_nested.learn.dqn.one_blas_thread import on_one_blas_thread

UPDATES = """
import hashlib
import numpy as np
from mc_nested.learn.dqn.compiled_engine.engine import CompiledEngine
from mc_nested.learn.dqn.engine import Batch, UpdateRule
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.state_space import StateSpace

space = StateSpace(np.array([[14, 14, 16, 1]]), actions=8, encoding="one-hot")
sizes = space.network([256, 256])
random = np.random.default_rng(0)
engine = CompiledEngine(space, sizes, UpdateRule(64, 1e-3, 5, 1.0), initial_parameters(sizes, random)[None])
for _ in range(20):
    states, actions = random.integers(0, space.count, (2, 1, 64)), random.integers(0, 8, (1, 64))
    rewards, ones = random.random((1, 64)).astype(np.float32), np.ones((1, 64), np.float32)
    engine.update(np.array([0]), Batch(states, actions, rewards, ones, ones > 1, ones))
engine.q_values(np.array([5]))
print(hashlib.sha256(engine.online.tobytes()).hexdigest())
"""


def blas_threads() -> set[int]:
    return {library.num_threads for library in ThreadpoolController().select(user_api="blas").lib_controllers}


def parameters_with(threads: str, core: str) -> str:
    """A hash of the parameters after 20 updates in a process whose BLAS is allowed that many threads."""
    allowed = {"OPENBLAS_NUM_THREADS": threads, "MKL_NUM_THREADS": threads, "OPENBLAS_CORETYPE": core}
    variables = {name: value for name, value in os.environ.items() if name != "OMP_NUM_THREADS"} | allowed
    done = subprocess.run([sys.executable, "-c", UPDATES], env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


# What a second thread changes depends on the processor; in OpenBLAS's code for old ones it changes these updates.
@pytest.mark.parametrize("core", ["", "Prescott"])
def test_updates_are_the_same_to_the_bit_however_many_threads_a_blas_is_allowed(core: str) -> None:
    assert parameters_with("1", core) == parameters_with("2", core)


@on_one_blas_thread
def inside() -> set[int]:
    return blas_threads()


@on_one_blas_thread
def twice_inside() -> list[set[int]]:
    return [inside(), blas_threads()]


def test_the_process_has_its_number_again_afterwards() -> None:
    with threadpool_limits(3, user_api="blas"):
        before = blas_threads()
        assert inside() == {1}
        assert blas_threads() == before
        assert twice_inside() == [{1}, {1}]
        assert blas_threads() == before


@on_one_blas_thread
def fails() -> None:
    raise ConnectionError


def test_after_an_error_too() -> None:
    with threadpool_limits(3, user_api="blas"):
        before = blas_threads()
        with pytest.raises(ConnectionError):
            fails()
        assert blas_threads() == before


def test_as_long_as_one_python_thread_is_inside_it_stays_at_one() -> None:
    came, may_go = threading.Event(), threading.Event()

    @on_one_blas_thread
    def stays() -> None:
        came.set()
        assert may_go.wait(10)

    with threadpool_limits(3, user_api="blas"):
        before = blas_threads()
        other = threading.Thread(target=stays)
        other.start()
        assert came.wait(10)
        assert inside() == {1}
        assert blas_threads() == {1}, "the other is still inside"
        may_go.set()
        other.join()
        assert blas_threads() == before
