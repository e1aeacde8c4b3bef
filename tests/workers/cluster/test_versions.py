"""The versions that have to be the same on both ends, and the words about a difference."""

from pathlib import Path

import pytest

from mc_nested.workers.cluster import job_task
from mc_nested.workers.cluster.job_task import LIBRARIES, differences, own_versions


def test_own_versions_do_not_differ_from_themselves() -> None:
    assert differences(own_versions(), own_versions()) == ""
    assert set(own_versions()) == {"mc-nested", *LIBRARIES}


def test_version_of_another_agents_library_is_compared_too() -> None:
    wanted = own_versions("no-such-library")
    assert wanted["no-such-library"] == "missing"
    assert "gymnasium" in wanted
    assert differences({**wanted, "no-such-library": "1.0"}, wanted) == "no-such-library missing instead of 1.0"


def test_differences_name_each_library_with_both_versions() -> None:
    wanted = {"mc-nested": "0.1.0 (a)", "numpy": "2", "numba": "1"}
    own = {"mc-nested": "0.1.0 (b)", "numpy": "2"}
    assert differences(wanted, own) == "mc-nested 0.1.0 (b) instead of 0.1.0 (a), numba missing instead of 1"


def test_any_change_of_a_file_counts_except_its_line_endings(tmp_path: Path) -> None:
    for package in job_task.PACKAGES:
        (tmp_path / package).mkdir()
    file = tmp_path / job_task.PACKAGES[0] / "a.py"
    file.write_bytes(b"x = 1\ny = 2\n")
    before = job_task._hash_of_files(tmp_path)
    file.write_bytes(b"x = 1\r\ny = 2\r\n")
    assert job_task._hash_of_files(tmp_path) == before
    file.write_bytes(b"x = 1\ny = 3\n")
    assert job_task._hash_of_files(tmp_path) != before
    file.rename(file.with_name("b.py"))
    file.with_name("b.py").write_bytes(b"x = 1\ny = 2\n")
    assert job_task._hash_of_files(tmp_path) != before


@pytest.mark.parametrize("name", LIBRARIES)
def test_difference_in_any_library_is_named(name: str) -> None:
    assert differences(own_versions(), {**own_versions(), name: "0"}).startswith(f"{name} 0 instead of")
