"""What scripts/test.py runs is there: a test file that has moved would leave its check with nothing to run."""

from pathlib import Path

import pytest

from scripts.test import KERNELS

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("path", KERNELS)
def test_tests_of_compiled_code_are_where_it_looks_for_them(path: str) -> None:
    assert (ROOT / path).is_file()
