"""A Windows desktop under Wine, for tests marked ``wine`` (scripts/windows.py)."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from scripts.windows import CACHE, set_up
from scripts.windows_session import Session, open_session
from tests.found_or_skipped import found_or_skipped


@pytest.fixture(scope="session")
def windows() -> Iterator[Session]:
    """Return a desktop with a Windows Python and this project's packages, for the session; fetched if it is missing."""
    with ExitStack() as stack:
        found_or_skipped(lambda: stack.enter_context(set_up(CACHE)))
        yield stack.enter_context(open_session(CACHE))
