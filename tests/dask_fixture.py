"""Sockets that Dask leaves for the garbage collector: of connections that were cut or refused, never closed by hand."""

import gc
import warnings
from collections.abc import Iterator

import pytest

LEFTOVERS = pytest.mark.filterwarnings(
    "ignore:unclosed:ResourceWarning", "ignore:Exception ignored in:pytest.PytestUnraisableExceptionWarning"
)
"""For modules whose tests open connections of Dask's."""


@pytest.fixture(autouse=True, scope="module")
def leftovers() -> Iterator[None]:
    """Collect leftovers before the next module; after each test it would cost more than most of the tests."""
    yield
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        gc.collect()
