"""How many processes train a study at a time."""

from mc_nested.cli.study_run import MOST_JOBS, cores


def test_there_is_at_least_one_core_and_never_too_many() -> None:
    assert 1 <= cores() <= MOST_JOBS
