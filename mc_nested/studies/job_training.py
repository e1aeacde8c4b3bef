"""Train one job: tick by tick, saved once every evaluation interval; at the end its outcome is written."""

import shutil
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray

from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arrays import Arrays, Int64s
from mc_nested.atomic_file import refused_as
from mc_nested.errors import RunError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.builders import Builders
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.learnt_game import given_facts_of
from mc_nested.learn.objectives.weights import shipped_weights
from mc_nested.learn.runs.checkpoint import Checkpoint, fingerprint
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.unknown_design import UnknownDesigns
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import Evaluated, JobOutcome, RunOutcome, evaluated, write_outcome


class JobTraining:
    """Trains a job in its folder, from where it was last saved.

    Args:
        job: what is trained.
        folder: the job's own; made at the first save.
        trainer: an untrained one for the job's runs (agents_trainer).
    """

    def __init__(self, job: Job, folder: Path, trainer: Trainer) -> None:
        self.job = job
        self.trainer = trainer
        self._updates_at: list[int] = []
        """Those of its run before each evaluation."""
        self._folder = folder
        anew = f"delete {folder}, and this job alone begins anew"
        self._checkpoint = Checkpoint(folder / "checkpoint", job.identity(), anew)
        self._seconds_before = 0.0
        self._began = time.thread_time()
        if self._checkpoint.exists:
            self._checkpoint.load_into(self)
        self._saved_at = self.trainer.episodes_done.copy()

    @property
    def finished(self) -> bool:
        """Whether every run has ended: then ``finish`` is next."""
        return self.trainer.finished

    @property
    def episodes_done(self) -> Int64s:
        """Training episodes completed, (runs,)."""
        return self.trainer.episodes_done

    @property
    def evaluation_rows(self) -> Sequence[EvaluationRow]:
        """The greedy episodes so far, of all runs."""
        return self.trainer.evaluation_rows

    @property
    def updates(self) -> int:
        """Updates of all networks so far."""
        return self.trainer.agent.updates

    def tick(self) -> None:
        """Take a step of every run, and save if a run has trained for an evaluation interval since the last save.

        RunError if the disk refuses; the last save is intact then.
        """
        self.trainer.tick()
        self._count_updates()
        if (self.trainer.episodes_done - self._saved_at).max() >= self.job.preset.evaluate_every:
            self.save()

    def save(self) -> None:
        """Save it as it is now; RunError as for ``tick``."""
        with refused_as(RunError, self._folder, "make room"):
            self._checkpoint.save(self)
        self._saved_at = self.trainer.episodes_done.copy()

    def finish(self) -> None:
        """Write the outcome and delete the checkpoint, which is mostly replays that nobody needs any more.

        RunError if the disk refuses.
        """
        write_outcome(self._folder, self._outcome())
        shutil.rmtree(self._folder / "checkpoint", ignore_errors=True)

    def state(self) -> Arrays:
        """Return what the checkpoint keeps: the trainer's, the seconds so far, and what each evaluation had cost."""
        spent = np.array(self._spent(self._steps()), dtype=np.int64).reshape(-1, 2)
        return {**self.trainer.state(), "job.seconds": np.array([self._seconds()]), "spent.at": spent}

    def marks(self) -> Arrays:
        """Return the trainer's marks, for the checkpoint."""
        return self.trainer.marks()

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """Return the trainer's journal, for the checkpoint."""
        return self.trainer.journal(since)

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None:
        """Go on from what the checkpoint has saved."""
        self.trainer.load(state, journals)
        self._seconds_before = float(state["job.seconds"][0])
        self._updates_at = state["spent.at"][:, 1].tolist()

    def _seconds(self) -> float:
        return self._seconds_before + time.thread_time() - self._began

    def _count_updates(self) -> None:
        """Note the updates at each new evaluation: no run is updated meanwhile, and it takes a tick at least."""
        if new := self.trainer.evaluation_rows[len(self._updates_at) :]:
            updates = self.trainer.agent.updates_by_run
            self._updates_at += [int(updates[row.trial]) for row in new]

    def _steps(self) -> list[Int64s]:
        """Return how many training steps each run had taken after each number of its episodes, from none on."""
        own: list[list[int]] = [[0] for _ in self.job.trials]
        for episode in self.trainer.episode_rows:
            own[episode.trial].append(episode.steps)
        return [np.cumsum(steps) for steps in own]

    def _spent(self, steps: Sequence[Int64s]) -> list[tuple[int, int]]:
        """Return the steps and updates of its run before each evaluation."""
        rows = self.trainer.evaluation_rows
        trained = [int(steps[row.trial][row.episode]) for row in rows]
        return list(zip(trained, self._updates_at, strict=True))

    def _outcome(self) -> JobOutcome:
        agent, runs, steps = self.trainer.agent, len(self.job.trials), self._steps()
        evaluations: list[list[Evaluated]] = [[] for _ in range(runs)]
        for row, spent in zip(self.trainer.evaluation_rows, self._spent(steps), strict=True):
            evaluations[row.trial].append(evaluated(row, self.job.scenarios[row.trial], spent))
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
                    score=float(self.trainer.policy_scores[run]),
                    updates=int(updates[run]),
                    env_steps=int(steps[run][-1]),
                    replay_bytes=None if held is None else int(held[run]),
                )
                for run in range(runs)
            ],
        )


def team_of_job(job: Job) -> Team | None:
    """Return the builders who share an arena in each of its runs, all of one scenario; None where one builds alone."""
    return team_of(job.scenarios[0], job.arm.builders) if job.arm.builders else None


def agents_trainer(job: Job, env: VectorEnv[Int64s, Int64s, Any]) -> Trainer:
    """Return the trainer of a job; ``env`` has the arena of each of its runs, as the simulator makes them."""
    team = team_of_job(job)
    builders = Builders(team.starts, job.arm.networks) if team else None
    spec = AGENT_SPECS[builders.agent] if builders else job.arm.spec
    agent: Agent
    if job.preset.objectives:
        agent = UnknownDesigns(shipped_weights(), given_facts_of(job.scenarios))
    else:
        agent = Agent(spec, job.scenarios, job.preset, job.seed, job.trials, builders)
    view = agent.view_of(env, job.scenarios)
    return Trainer(view, job.scenarios, agent, job.preset, job.seed, job.arm.stop_at_optimum)
