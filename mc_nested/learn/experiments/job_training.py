"""Training one job: tick by tick, saved once every evaluation interval; at the end its outcome is written."""

import shutil
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, ValidationError

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Float64s, Int64s
from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.evaluation import GreedyEpisode
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.experiments.spent import SpentSoFar, Updated
from mc_nested.learn.runs.checkpoint import Checkpoint, fingerprint
from mc_nested.learn.state_dict import named_for, part_of

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
    """What an outcome says about a greedy episode on that scenario, and the (steps, updates) spent by then."""
    material = GreedyEpisode([row.material]).material_name(scenario)
    steps, updates = spent or (None, None)
    return Evaluated(
        episode=row.episode,
        score=row.score,
        material=material,
        steps=row.steps,
        trained_steps=steps,
        updates=updates,
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
        """One run's share of the seconds, by its updates."""
        updates = sum(each.updates for each in self.runs)
        return self.seconds * run.updates / updates if updates else 0.0


class TrainedJob(Protocol):
    """A job that is trained in its folder, by whatever algorithm; each method raises RunError if the disk refuses."""

    job: Job

    @property
    def finished(self) -> bool:
        """Whether every run has ended: then ``finish`` is next."""
        ...

    @property
    def episodes_done(self) -> Int64s:
        """Training episodes completed, (runs,)."""
        ...

    @property
    def evaluation_rows(self) -> Sequence[EvaluationRow]:
        """The greedy episodes so far, of all runs."""
        ...

    @property
    def updates(self) -> int:
        """Updates of all networks so far."""
        ...

    def tick(self) -> None:
        """A little of the training."""
        ...

    def save(self) -> None:
        """Save what the rest of the training needs: after it, a new one of the same job and folder goes on."""
        ...

    def finish(self) -> None:
        """Write the outcome, and leave nothing else."""
        ...


class Counted(Updated, Protocol):
    """The agents of some runs, and what they take."""

    @property
    def networks(self) -> int: ...
    @property
    def parameters(self) -> int: ...
    @property
    def updates(self) -> int: ...
    @property
    def replay_bytes(self) -> Int64s: ...


class Trains(Protocol):
    """A trainer of this project's: of agents (trainer.py), or of teams (cooperation/team_trainer.py)."""

    @property
    def agent(self) -> Counted: ...
    @property
    def episode_rows(self) -> Sequence[EpisodeRow]: ...
    @property
    def evaluation_rows(self) -> Sequence[EvaluationRow]: ...
    @property
    def finished(self) -> bool: ...
    @property
    def episodes_done(self) -> Int64s: ...
    @property
    def kept_scores(self) -> Float64s: ...
    def tick(self) -> None: ...
    def state(self) -> Arrays: ...
    def marks(self) -> Arrays: ...
    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays: ...
    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None: ...


class JobTraining:
    """Trains a job in its folder, from where it was last saved.

    Args:
        job: what is trained.
        folder: the job's own; made at the first save.
        trainer: an untrained one for the job's runs (job_trainers.py).
    """

    def __init__(self, job: Job, folder: Path, trainer: Trains) -> None:
        self.job = job
        self.trainer = trainer
        self._spent = SpentSoFar(len(job.trials))
        self._folder = folder
        self._checkpoint = Checkpoint(folder / "checkpoint", job.identity())
        self._seconds_before = 0.0
        self._began = time.thread_time()
        if self._checkpoint.exists:
            self._checkpoint.load_into(self)
        self._saved_at = self.trainer.episodes_done.copy()

    @property
    def finished(self) -> bool:
        return self.trainer.finished

    @property
    def episodes_done(self) -> Int64s:
        return self.trainer.episodes_done

    @property
    def evaluation_rows(self) -> Sequence[EvaluationRow]:
        return self.trainer.evaluation_rows

    @property
    def updates(self) -> int:
        return self.trainer.agent.updates

    def tick(self) -> None:
        """One step of every run; saved if a run has trained for an evaluation interval since the last save.

        RunError if the disk refuses; the last save is intact then.
        """
        self.trainer.tick()
        self._spent.count(self.trainer)
        if (self.trainer.episodes_done - self._saved_at).max() >= self.job.preset.evaluate_every:
            self.save()

    def save(self) -> None:
        """Save it as it is now; RunError as for ``tick``."""
        with writing(self._folder):
            self._checkpoint.save(self)
        self._saved_at = self.trainer.episodes_done.copy()

    def finish(self) -> None:
        """Write the outcome and delete the checkpoint, which is mostly replays that nobody needs any more.

        RunError if the disk refuses.
        """
        with writing(self._folder):
            write_outcome(self._folder, self._outcome())
        shutil.rmtree(self._folder / "checkpoint", ignore_errors=True)

    def state(self) -> Arrays:
        """For the checkpoint: the trainer's, and the seconds so far."""
        spent = named_for("spent", self._spent.state())
        return {**self.trainer.state(), "job.seconds": np.array([self._seconds()]), **spent}

    def marks(self) -> Arrays:
        """For the checkpoint."""
        return self.trainer.marks()

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """For the checkpoint."""
        return self.trainer.journal(since)

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None:
        """For the checkpoint."""
        self.trainer.load(state, journals)
        self._seconds_before = float(state["job.seconds"][0])
        self._spent.load(part_of(state, "spent"), self.trainer)

    def _seconds(self) -> float:
        return self._seconds_before + time.thread_time() - self._began

    def _outcome(self) -> JobOutcome:
        agent, runs = self.trainer.agent, len(self.job.trials)
        evaluations: list[list[Evaluated]] = [[] for _ in range(runs)]
        for row, spent in zip(self.trainer.evaluation_rows, self._spent.at, strict=True):
            evaluations[row.trial].append(evaluated(row, self.job.scenarios[row.trial], spent))
        steps = np.zeros(runs, dtype=np.int64)
        for trained in self.trainer.episode_rows:
            steps[trained.trial] += trained.steps
        updates = agent.updates_by_run
        held = None if self.job.preset.imagination else agent.replay_bytes
        return JobOutcome(
            identity=fingerprint(self.job.identity()),
            networks=agent.networks,
            parameters=agent.parameters,
            seconds=round(self._seconds(), 3),
            runs=[
                RunOutcome(
                    evaluations=evaluations[run],
                    score=float(self.trainer.kept_scores[run]),
                    updates=int(updates[run]),
                    env_steps=int(steps[run]),
                    replay_bytes=None if held is None else int(held[run]),
                )
                for run in range(runs)
            ],
        )


@contextmanager
def writing(folder: Path) -> Iterator[None]:
    """While something is written in a job's folder: RunError, one line if the disk refuses."""
    try:
        yield
    except OSError as error:
        raise RunError(f"{folder}: can't be written ({error}): make room") from error


def write_outcome(folder: Path, outcome: JobOutcome) -> None:
    """Write a finished job's outcome to its folder, atomically; OSError if the disk refuses."""
    folder.mkdir(parents=True, exist_ok=True)
    with atomic_write(folder / OUTCOME) as unfinished:
        unfinished.write_text(outcome.model_dump_json(), encoding="utf-8")


def outcome_of(job: Job, folder: Path) -> JobOutcome | None:
    """The outcome of the job in that folder; None if it isn't finished.

    RunError if the file can't be read, or is another job's.
    """
    path = folder / OUTCOME
    if not path.exists():
        return None
    try:
        outcome = JobOutcome.model_validate_json(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, ValidationError) as error:
        raise RunError(f"{path}: can't be read as the outcome of a training: remove it to train that again") from error
    if outcome.identity != fingerprint(job.identity()):
        raise RunError(f"{path}: belongs to another experiment: put back the file that was there")
    return outcome
