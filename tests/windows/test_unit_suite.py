"""The unit tests of code that differs on Windows (scripts/windows.py), by a Windows Python under Wine."""

from pathlib import Path

import pytest

from scripts.test import cases_in
from scripts.windows import PYTEST, SUITE, WHERE_WINDOWS_DIFFERS
from scripts.windows_parts import windows_path
from scripts.windows_session import Session

pytestmark = pytest.mark.wine

TIMEOUT_S = 900
FEWEST = 1250
"""At least so many tests must have passed: if fewer have, something was not collected."""


class Results:
    """The results of pytest under Wine: each test's module with its failure, None where it passed."""

    def __init__(self, code: int, printed: str, report: Path) -> None:
        self.code = code
        self.printed = printed
        self.outcomes = [
            (module, None if fault is None else f"{name}: {fault}") for module, name, fault in cases_in(report)
        ]

    def of(self, place: str) -> list[str | None]:
        """Return the outcomes of the tests in this file or folder."""
        module = place.removesuffix(".py").replace("/", ".")
        return [said for name, said in self.outcomes if name == module or name.startswith(f"{module}.")]


@pytest.fixture(scope="module")
def results(windows: Session, tmp_path_factory: pytest.TempPathFactory) -> Results:
    report = tmp_path_factory.mktemp("wine") / "report.xml"
    code, printed = windows.python(*PYTEST, *SUITE, f"--junit-xml={windows_path(report)}", timeout_s=TIMEOUT_S)
    assert report.is_file(), printed[-4000:]
    return Results(code, printed, report)


def test_unit_tests_under_wine_run_to_their_end(results: Results) -> None:
    assert results.code in (0, 1), results.printed[-4000:]
    assert sum(said is None for _, said in results.outcomes) >= FEWEST


@pytest.mark.parametrize("place", WHERE_WINDOWS_DIFFERS)
def test_unit_tests_of_each_place_pass_under_wine(results: Results, place: str) -> None:
    outcomes = results.of(place)
    assert outcomes
    assert not [said for said in outcomes if said is not None]
