"""How long a test may take, its fixtures with it: one that hangs is ended and named, and the others go on.

pytest-timeout does it. Where that isn't installed, as under Wine, nothing is bounded from within.
"""

import pytest

UNIT_S = 120.0
"""The slowest, alone, takes two seconds, and twenty where it is the one that compiles what Numba has no cache of."""

LIMITS_S = {"slow": 1200.0, "realtime": 600.0, "window": 1200.0, "standin": 2400.0, "wine": 3600.0}
"""By marker. The last three count what their session's first test fetches and installs."""


def limit_s(kinds: set[str]) -> float:
    """Return the seconds for a test with these markers: the most that any of them needs."""
    return max((seconds for kind, seconds in LIMITS_S.items() if kind in kinds), default=UNIT_S)


def bound(item: pytest.Item) -> None:
    """Give the test the limit of its kind, unless it has one of its own.

    A signal fails the test and leaves its process, its fixtures and all later tests as they are. Hypothesis, though,
    takes that for an example that fails, and tries it again, which hangs without a limit: there a thread ends the
    process, of which pytest-xdist says which test it was at, and which it replaces. On Windows there are no such
    signals, and pytest-timeout itself falls back on the thread.
    """
    if item.get_closest_marker("timeout") is None:
        limit = limit_s({marker.name for marker in item.iter_markers()})
        tries_again = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
        item.add_marker(pytest.mark.timeout(limit, method="thread") if tries_again else pytest.mark.timeout(limit))
