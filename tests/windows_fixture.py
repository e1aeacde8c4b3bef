"""A Windows desktop under Wine, for tests marked ``wine`` (scripts/windows.py)."""

import os
from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from scripts.standin_parts import MissingError
from scripts.windows import CACHE, set_up
from scripts.windows_session import Session, open_session


@pytest.fixture(scope="session")
def windows() -> Iterator[Session]:
    """A desktop with a Windows Python and this project's packages, for the session; fetched if it is missing.

    A machine where that is impossible skips the test and says how to get it; with CI set, that is a failure.
    """
    with ExitStack() as stack:
        try:
            stack.enter_context(set_up(CACHE))
        except MissingError as error:
            if os.environ.get("CI"):
                pytest.fail(str(error))
            pytest.skip(str(error))
        yield stack.enter_context(open_session(CACHE))
