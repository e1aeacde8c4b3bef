"""The workers of a cluster and the jobs that they train, by the scheduler's events."""

from mc_nested.workers.cluster.dask_jobs import ClusterWorkers

ONE, TWO = "tcp://127.0.0.1:1", "tcp://127.0.0.1:2"


def came(worker: str) -> dict[str, object]:
    return {"action": "add-worker", "worker": worker}


def went(worker: str, *, expected: bool) -> dict[str, object]:
    return {"action": "remove-worker", "worker": worker, "expected": expected}


def test_an_unfinished_job_that_no_worker_trains_counts_as_waiting() -> None:
    seen = ClusterWorkers([ONE])
    assert seen.in_words(3) == "1 worker, 0 jobs training, 3 waiting"
    seen.begins("a", ONE)
    seen.note(came(TWO))
    assert seen.trains("a")
    assert seen.in_words(3) == "2 workers, 1 job training, 2 waiting"
    seen.ends("a")
    assert not seen.trains("a")
    assert seen.in_words(2) == "2 workers, 0 jobs training, 2 waiting"


def test_job_whose_worker_left_counts_as_begun_again() -> None:
    seen = ClusterWorkers([ONE, TWO])
    seen.begins("a", ONE)
    seen.begins("b", TWO)
    seen.note(went(ONE, expected=False))
    assert (seen.trains("a"), seen.trains("b")) == (False, True)
    assert seen.in_words(2) == "1 worker, 1 job training, 1 waiting; lost 1 worker, 1 job begun again"
    seen.begins("a", TWO)
    seen.note(went(TWO, expected=True))
    assert seen.in_words(2) == "0 workers, 0 jobs training, 2 waiting; lost 2 workers, 3 jobs begun again"


def test_idle_worker_that_was_told_to_go_does_not_count_as_lost() -> None:
    seen = ClusterWorkers([ONE])
    seen.note(went(ONE, expected=True))
    assert seen.in_words(0) == "0 workers, 0 jobs training, 0 waiting"


def test_other_events_of_the_scheduler_are_ignored() -> None:
    seen = ClusterWorkers([ONE])
    seen.note({"action": "retire-workers"})
    seen.note({})
    assert seen.count == 1
