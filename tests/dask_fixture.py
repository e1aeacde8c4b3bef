"""What Dask leaves for the garbage collector: sockets of connections that were cut or refused, never closed by hand."""

import gc
import warnings
from collections.abc import Iterator

import pytest

LEFTOVERS = pytest.mark.filterwarnings(
    "ignore:unclosed:ResourceWarning", "ignore:Exception ignored in:pytest.PytestUnraisableExceptionWarning"
)
"""For modules whose tests open connections of Dask's."""


@pytest.fixture(autouse=True)
def leftovers() -> Iterator[None]:
    """They are collected before the next test, which may belong to another module."""
    yield
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        gc.collect()
