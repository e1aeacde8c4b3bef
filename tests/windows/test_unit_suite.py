"""The unit tests of what differs on Windows (scripts/windows_suite.py), by a Windows Python under Wine."""

import re

import pytest

from scripts.windows import PYTEST, SUITE
from scripts.windows_session import Session

pytestmark = pytest.mark.wine

TIMEOUT_S = 900
FEWEST = 1250
"""Tests that must have passed: fewer, and something was not collected."""


def test_the_unit_tests_of_what_differs_on_windows_pass_there(windows: Session) -> None:
    code, printed = windows.python(*PYTEST, *SUITE, timeout_s=TIMEOUT_S)
    assert code == 0, printed[-4000:]
    passed = re.search(r"(\d+) passed", printed)
    assert passed is not None
    assert int(passed[1]) >= FEWEST
