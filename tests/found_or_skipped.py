"""What a machine may lack: a test that needs it is skipped there, and says how to get it; with CI set, it fails."""

import os
from collections.abc import Callable
from typing import TypeVar

import pytest

from scripts.programs import MissingError

Found = TypeVar("Found")


def found_or_skipped(find: Callable[[], Found]) -> Found:
    """Return what was found."""
    try:
        return find()
    except MissingError as error:
        if os.environ.get("CI"):
            pytest.fail(str(error))
        pytest.skip(str(error))
