"""What reproduce and sweep share: no option beside --resume, a new folder, and as many processes as cores."""

from pathlib import Path

import pytest

from mc_nested.cli.experiment import MOST_JOBS, check_new_folder, check_nothing_beside_resume, cores
from mc_nested.errors import UserError


def test_resume_allows_no_other_option() -> None:
    check_nothing_beside_resume({"resume": Path("x"), "trials": None, "scenario": [], "agent": (), "ablation": False})
    with pytest.raises(UserError, match="leave out --ablation"):
        check_nothing_beside_resume({"resume": Path("x"), "ablation": True})
    with pytest.raises(UserError, match="leave out --as-json"):
        check_nothing_beside_resume({"resume": Path("x"), "as_json": 0})


def test_a_new_folder_has_to_be_named() -> None:
    assert check_new_folder(Path("x")) == Path("x")
    with pytest.raises(UserError, match="--out DIR"):
        check_new_folder(None)


def test_there_is_at_least_one_core_and_never_too_many() -> None:
    assert 1 <= cores() <= MOST_JOBS
