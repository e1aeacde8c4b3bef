"""What reproduce and sweep share: no option beside --resume, and as many processes as cores."""

from pathlib import Path

import pytest

from mc_nested.cli.experiment import MOST_JOBS, check_nothing_beside_resume, cores
from mc_nested.errors import UserError


def test_resume_allows_no_other_option() -> None:
    check_nothing_beside_resume({"resume": Path("x"), "trials": None, "scenario": [], "agent": (), "ablation": False})
    with pytest.raises(UserError, match="leave out --ablation"):
        check_nothing_beside_resume({"resume": Path("x"), "ablation": True})
    with pytest.raises(UserError, match="leave out --jobs"):
        check_nothing_beside_resume({"resume": Path("x"), "jobs": 0})


def test_how_to_print_it_may_be_said_beside_resume() -> None:
    check_nothing_beside_resume({"resume": Path("x"), "quiet": True, "as_json": True})


def test_there_is_at_least_one_core_and_never_too_many() -> None:
    assert 1 <= cores() <= MOST_JOBS
