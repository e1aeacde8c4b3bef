"""Runs of the planner (planner.py), episode by episode, through an arena's reset and step alone."""

import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import front_of
from mc_nested.arrays import Int64s
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.experiments.job_training import JobOutcome, RunOutcome, evaluated, write_outcome, writing
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.experiments.planner import next_test, plan_of_build
from mc_nested.learn.imagination.beliefs import Beliefs, believe
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.material_choice import scores_of_materials
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.learn.streams import practice_stream

LANDS = (0, 1)
"""Where a block lands, in cells from the agent: in front of it."""

WAITS = (Action.F, Action.B)
"""What it does in turn when there is nothing left to try: neither places a block."""


class PlannerTraining:
    """Plays a job's runs one after the other. A stopped one starts over, and goes the same way: its seed decides all.

    An episode that builds all of a design that is known counts as the greedy one; there is one of them between two
    others, as for every agent.

    Args:
        job: what is played.
        folder: the job's own; made when it is finished.
        arenas: an arena for each run.
    """

    def __init__(self, job: Job, folder: Path, arenas: VectorEnv[Int64s, Int64s, Any]) -> None:
        self.job = job
        self.evaluation_rows: list[EvaluationRow] = []
        self._env = arenas
        self._folder = folder
        self._began = time.thread_time()
        runs = len(job.trials)
        self._experience = [Experience() for _ in range(runs)]
        self._episodes = np.zeros(runs, dtype=np.int64)
        self._evaluated_at = np.full(runs, -1)
        self._steps = np.zeros(runs, dtype=np.int64)
        self._finished = np.zeros(runs, dtype=np.bool_)

    @property
    def finished(self) -> bool:
        return bool(self._finished.all())

    @property
    def episodes_done(self) -> Int64s:
        return self._episodes

    @property
    def evaluation_rows_of_run(self) -> Sequence[Sequence[EvaluationRow]]:
        """The greedy episodes of each run."""
        return [[row for row in self.evaluation_rows if row.trial == run] for run in range(len(self.job.trials))]

    @property
    def updates(self) -> int:
        """None: there is no network."""
        return 0

    def tick(self) -> None:
        """One episode of the first run that isn't finished."""
        run = int(self._finished.argmin())
        over = self._episodes[run] >= self.job.preset.episodes
        greedy = over or (not self._beliefs(run).explores and self._episodes[run] > self._evaluated_at[run])
        score, material, steps = self._play(run, explores=not greedy)
        if not greedy:
            self._episodes[run] += 1
            self._steps[run] += steps
            return
        self.evaluation_rows.append(EvaluationRow(run, int(self._episodes[run]), score, material, steps))
        self._evaluated_at[run] = self._episodes[run]
        self._finished[run] = over or score >= self.job.scenarios[run].optimum

    def save(self) -> None:
        """Nothing: a run takes a second or two, and starts over."""

    def finish(self) -> None:
        outcome = JobOutcome(
            identity=fingerprint(self.job.identity()),
            networks=0,
            parameters=0,
            seconds=round(time.thread_time() - self._began, 3),
            runs=[
                RunOutcome(
                    evaluations=[evaluated(row, self.job.scenarios[run]) for row in rows],
                    score=max(row.score for row in rows),
                    updates=0,
                    env_steps=int(self._steps[run]),
                )
                for run, rows in enumerate(self.evaluation_rows_of_run)
            ],
        )
        with writing(self._folder):
            write_outcome(self._folder, outcome)

    def _beliefs(self, run: int) -> Beliefs:
        scenario = self.job.scenarios[run]
        return believe(self._experience[run].steps, LANDS, scenario.size, scenario.blocks)

    def _play(self, run: int, explores: bool) -> tuple[float, int, int]:
        """Play an episode, and remember what it showed: its score, its material and its steps."""
        scenario, seen = self.job.scenarios[run], self._experience[run]
        most = self._beliefs(run).most
        scores = scores_of_materials(seen.extras, len(scenario.materials), scenario.blocks, most)
        material = int(scores.argmax())
        others = np.zeros(len(self.job.trials), dtype=np.int64)
        masked = np.arange(len(others)) == run
        observations, _ = self._env.reset(options={"reset_mask": masked, "material": others + material * masked})
        seen.begin()
        before = observations[run].copy()
        actions = self._choices(run, explores)
        steps, over = 0, False
        while not over:
            action = int(next(actions))
            observations, rewards, terminated, truncated, info = self._env.step(np.where(masked, action, others))
            after = observations[run].copy()
            step = [*before.tolist(), action, *after.tolist(), int(rewards[run] > 0), material]
            seen.add(RealStep(*step))
            before, steps, over = after, steps + 1, bool(terminated[run] or truncated[run])
        score = float(info["score"][run])
        seen.end(material, score)
        return score, material, steps

    def _choices(self, run: int, explores: bool) -> Iterator[Action]:
        """The actions of an episode, without an end; each is chosen after what the last one showed is remembered."""
        scenario, seen = self.job.scenarios[run], self._experience[run]
        random = practice_stream(self.job.seed, self.job.trials[run], seen.episodes)
        if not (explores and self._beliefs(run).explores):
            yield from plan_of_build(scenario, self._beliefs(run))
        first = int(seen.first_of_episode[-1])
        while explores and self._beliefs(run).explores:
            own = seen.steps[first:]
            cell = tuple(own[-1, 4:6].tolist()) if len(own) else scenario.start
            plan = next_test(
                cell, _placed(own), scenario.step_limit - len(own), self._beliefs(run), scenario.blocks, random
            )
            if not plan:
                break
            yield from plan
        while True:
            yield from WAITS


def _placed(steps: Int64s) -> set[Cell]:
    """Where the blocks of these transitions stand."""
    used = steps[:, 2] > steps[:, 6]
    return {front_of((x, y)) for x, y in steps[used][:, 4:6].tolist()}
