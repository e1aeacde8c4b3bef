"""What came of a job: outcome.json in its folder."""

from pathlib import Path

from pydantic import BaseModel, ConfigDict

from mc_nested.arena.scenario import Scenario
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import RunError
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.evaluation import GreedyEpisode
from mc_nested.learn.runs.checkpoint import fingerprint, sealed, unsealed
from mc_nested.studies.job import Job

OUTCOME = "outcome.json"


class Evaluated(BaseModel):
    """One greedy episode after ``episode`` training episodes; ``score`` is r_M.

    ``trained_steps`` and ``updates`` are what the run had spent by then, None where that wasn't counted.
    """

    model_config = ConfigDict(frozen=True)

    episode: int
    score: float
    material: str
    steps: int
    trained_steps: int | None = None
    updates: int | None = None


def evaluated(row: EvaluationRow, scenario: Scenario, spent: tuple[int, int] | None = None) -> Evaluated:
    """Return what an outcome says about a greedy episode on that scenario, and the (steps, updates) spent by then."""
    material = GreedyEpisode([row.material]).material_name(scenario)
    steps, updates = spent or (None, None)
    return Evaluated(
        episode=row.episode, score=row.score, material=material, steps=row.steps, trained_steps=steps, updates=updates
    )


class RunOutcome(BaseModel):
    """The outcome of one run: its evaluations in order, the score of the policy it keeps, its updates and steps.

    ``replay_bytes``: of what its replays hold at its end; None where it wasn't measured, or practises in a learnt game.
    """

    model_config = ConfigDict(frozen=True)

    evaluations: list[Evaluated]
    score: float
    updates: int
    env_steps: int
    replay_bytes: int | None = None


class JobOutcome(BaseModel):
    """The outcome of a job; ``networks`` and ``parameters`` are per run, ``seconds`` of computing are of all runs."""

    model_config = ConfigDict(frozen=True)

    identity: str
    networks: int
    parameters: int
    seconds: float
    runs: list[RunOutcome]

    def seconds_of(self, run: RunOutcome) -> float:
        """Return one run's share of the seconds, by its updates; by its steps where none of them updates anything."""
        updates = sum(each.updates for each in self.runs)
        work, own = (updates, run.updates) if updates else (sum(each.env_steps for each in self.runs), run.env_steps)
        return self.seconds * own / work if work else 0.0


def write_outcome(folder: Path, outcome: JobOutcome) -> None:
    """Write a finished job's outcome to its folder, atomically; RunError if the disk refuses."""
    with refused_as(RunError, folder, "make room"):
        folder.mkdir(parents=True, exist_ok=True)
        with atomic_write(folder / OUTCOME) as unfinished:
            unfinished.write_text(sealed(outcome.model_dump()), encoding="utf-8")


def outcome_of(job: Job, folder: Path) -> JobOutcome | None:
    """Return the outcome of the job in that folder; None if it isn't finished.

    RunError if the file can't be read, or is another job's.
    """
    path = folder / OUTCOME
    if not path.exists():
        return None
    try:
        outcome = JobOutcome.model_validate(unsealed(path))
    except (OSError, ValueError) as error:
        raise RunError(f"{path}: can't be read as the outcome of a training: remove it to train that again") from error
    if outcome.identity != fingerprint(job.identity()):
        raise RunError(f"{path}: belongs to another experiment: put back the file that was there")
    return outcome
