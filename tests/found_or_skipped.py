"""Skip a test on a machine that lacks what it needs, and say how to get that; with CI set, fail it."""

import os
from collections.abc import Callable
from typing import TypeVar

import pytest

from scripts.programs import MissingError

Found = TypeVar("Found")


def found_or_skipped(find: Callable[[], Found]) -> Found:
    """Return what ``find`` finds; where that is missing, skip the test, or fail it with CI set."""
    try:
        return find()
    except MissingError as error:
        if os.environ.get("CI"):
            pytest.fail(str(error))
        pytest.skip(str(error))
