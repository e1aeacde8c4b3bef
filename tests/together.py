"""Which tests one of xdist's processes runs together, with ``--dist loadgroup``: those that share what is opened once.

xdist's own marks of groups have no effect with pytest 9.2, which keeps a test's name elsewhere.
"""

import pytest
from xdist.scheduler import LoadScopeScheduling  # type: ignore[import-untyped]

TOGETHER = {
    "tests/windows/": "a Wine desktop, whose folder no second one may use",
    "tests/test_rehearsal_end_to_end.py::test_a_current_version_": "a machine, on which each slows another",
    "tests/test_games_end_to_end.py": "a window with its arena",
    "tests/live/desktop/test_xwayland.py": "Wayland desktops",
    "tests/test_installers.py": "a folder of packages",
    "tests/test_wheel.py": "an environment with everything that the wheel needs",
    "tests/docs/test_site.py": "the built site",
    "tests/cli/test_reproduce.py": "whole reproductions",
    "tests/cli/test_cluster.py": "a cluster",
}
"""Files and folders of tests, and what theirs share."""


class TogetherScheduling(LoadScopeScheduling):  # type: ignore[misc]  # xdist has no types
    """Tests outside ``TOGETHER`` are given out one by one, after the groups."""

    def _split_scope(self, nodeid: str) -> str:
        return scope_of(nodeid)


def scope_of(nodeid: str) -> str:
    """Return the name of a test's group: the same for those that share something, its own name for any other."""
    return next((place for place in TOGETHER if nodeid.startswith(place)), nodeid)


def scheduler(config: pytest.Config, log: object) -> TogetherScheduling | None:
    """Return the scheduler that gives out the tests; None where xdist does it in a way of its own."""
    return TogetherScheduling(config, log) if config.getoption("dist") == "loadgroup" else None
