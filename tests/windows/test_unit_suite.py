"""The unit suite of what plays and calibrates, by a Windows Python under Wine."""

import re
from contextlib import ExitStack

import pytest

from scripts.windows import PYTEST, SUITES
from scripts.windows_session import Session

pytestmark = pytest.mark.wine

TIMEOUT_S = 1200
FEWEST = 2500
"""Tests that must have passed: fewer, and something was not collected."""


def test_the_unit_suite_passes_on_windows(windows: Session) -> None:
    with ExitStack() as stack:
        runs = [stack.enter_context(windows.started(*PYTEST, *suite)) for suite in SUITES]
        codes = [run.wait(TIMEOUT_S) for run in runs]
        printed = [run.printed() for run in runs]
    assert codes == [0] * len(runs), "\n".join(text[-4000:] for text in printed)
    passed = sum(int(found[1]) for text in printed if (found := re.search(r"(\d+) passed", text)))
    assert passed >= FEWEST
