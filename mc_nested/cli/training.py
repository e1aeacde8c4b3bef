"""A training as the command line runs it: until it is finished or stopped, saved on the way, shown as it goes on."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mc_nested.atomic_file import atomic_write
from mc_nested.cli.earlier_run import EarlierRun, earlier_run
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.options import Backend, open_arenas, played_live, where_words
from mc_nested.cli.output import Output
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.cli.recording_options import live_recorder
from mc_nested.cli.screen_states import as_shown
from mc_nested.cli.training_end import MAP, say_end
from mc_nested.cli.training_view import TrainingView
from mc_nested.cli.viewing import Viewed, viewed
from mc_nested.errors import DesktopError, LiveError, NotInFrontError
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.training import Training
from mc_nested.live.action_log import FailureBudget
from mc_nested.report.arena_map import draw_map
from mc_nested.report.curve import align_trials, draw_curve
from mc_nested.report.game_time import expected
from mc_nested.report.played import played_by
from mc_nested.report.played_curve import draw_played_curve
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from mc_nested.view.publisher import Publisher
from mc_nested.view.status_files import remove_status
from mc_nested.workers.cluster.address import SchedulerAddress

SAVE_EVERY_S = {Backend.SIM: 60.0, Backend.VIRTUAL: 60.0, Backend.LIVE: 15.0}
"""Seconds between checkpoints, which is what a kill can cost: in the simulator, or in a game of a block per second."""


@dataclass(frozen=True)
class HowToRun:
    """What a run is asked for that its config.toml doesn't say; ``games`` have joined that scheduler."""

    output: Output
    server_allowed: bool = False
    record: str | None = None
    is_viewed: bool = False
    games: SchedulerAddress | None = None


@dataclass(frozen=True)
class _Training:
    """One training while it runs."""

    folder: RunFolder
    trainer: Trainer
    interrupt: Interrupt
    publisher: Publisher
    save: Callable[[], dict[str, Any]]
    failure_budget: FailureBudget


def run_training(
    folder: RunFolder, profile: str | None, resumed: bool, how: HowToRun, begin_from: Path | None = None
) -> None:
    """Train until the run is finished or somebody stops it; saved on the way and at the end."""
    config, output = folder.config, how.output
    earlier = earlier_run(begin_from, folder) if begin_from else None
    began = time.monotonic() - (folder.wall_s_so_far() if resumed else 0.0)
    with catch_interrupts() as interrupt, published(folder, how) as view:
        board = view.publisher.board
        what = f"train-{folder.scenario.name}"
        with open_arenas(
            Backend(config.backend),
            profile,
            folder.scenarios,
            server_allowed=how.server_allowed,
            evidence=folder.path / "evidence",
            open_recorder=live_recorder(how.record, what, folder.scenario, server_allowed=how.server_allowed),
            journal=board,
            seed=config.seed,
        ) as (env, log):
            agent = folder.new_agent(config.trials, config.preset.device)
            arenas = agent.view_of(as_shown(env, config.preset.states), folder.scenarios)
            trainer = Trainer(arenas, folder.scenarios, agent, config.preset, config.seed, config.stop_at_optimum)
            begin_or_resume(folder, trainer, earlier, resumed)
            if not resumed and Backend(config.backend) is Backend.LIVE:
                expectation = expected(config.preset, folder.scenario, stop_at_optimum=config.stop_at_optimum)
                output.note(expectation.line(folder.scenario))
            output.note(f"run:        {folder.path}")
            failure_budget = FailureBudget()

            def save() -> dict[str, Any]:
                wall_s = time.monotonic() - began - view.publisher.paused_s
                return folder.save(trainer, wall_s, played_live(log, failure_budget))

            training = _Training(folder, trainer, interrupt, view.publisher, save, failure_budget)
            shown = TrainingView(board, trainer, folder.scenario, env, config)
            try:
                _tick_until_done(training, shown, output)
            except (LiveError, DesktopError) as error:
                trainer.abandon_episodes()
                save()
                raise LiveError(f"{error}; saved: go on with mc-nested train --resume {folder.path}") from error
            board.does("saves, and draws its curve")
            summary = save()
        draw_results(folder, trainer)
        if not trainer.finished:
            raise Stopped(f"stopped and saved: go on with mc-nested train --resume {folder.path}")
    say_end(output, folder.path, config, summary)


def begin_or_resume(folder: RunFolder, trainer: Training, earlier: EarlierRun | None, resumed: bool) -> None:
    """Let the trainer go on from the folder's checkpoint; otherwise from an earlier run, if any, in a new folder.

    RunError as ``RunFolder`` and ``EarlierRun`` raise it.
    """
    if resumed:
        folder.checkpoint.load_into(trainer)
        return
    if earlier:
        earlier.begin(trainer)
        folder.save_before_all(trainer)
    folder.begin()


@contextmanager
def published(folder: RunFolder, how: HowToRun) -> Iterator[Viewed]:
    """The run where ``mc-nested view`` finds it; nothing is left of one that never began."""
    config = folder.config
    where = where_words(Backend(config.backend))
    title = f"{folder.scenario.name}, {config.agent} agent, preset {Path(config.preset_name).stem}, {where}"
    try:
        with viewed(how.is_viewed, "train", title, folder.path) as view:
            yield view
    finally:
        if not folder.has_begun:
            remove_status(folder.path)


def _tick_until_done(training: _Training, shown: TrainingView, output: Output) -> None:
    folder, trainer, interrupt = training.folder, training.trainer, training.interrupt
    every = SAVE_EVERY_S[Backend(folder.config.backend)]
    save_at = time.monotonic() + every
    events = events_of(folder, trainer)
    with TrainingProgress(folder.scenario, trainer, output.progress, lambda: interrupt.requested) as progress:
        if not progress.in_terminal:
            interrupt.says = STOPPING
        shown.show()
        while not (trainer.finished or interrupt.requested):
            _tick(training)
            progress.show()
            shown.show()
            if events:
                with folder.writing():
                    events.write()
            if time.monotonic() >= save_at:
                training.save()
                save_at = time.monotonic() + every
            if not trainer.finished:
                training.publisher.wait_while_paused(lambda: interrupt.requested)
    shown.show_end()


def _tick(training: _Training) -> None:
    """One tick. A mishap in a running game costs its episode, and is counted.

    Not counted is that a person who pauses, or did so shortly before, is in another window.
    """
    trainer = training.trainer
    try:
        trainer.tick()
    except LiveError as error:
        if not (isinstance(error, NotInFrontError) and training.publisher.was_paused_lately):
            training.failure_budget.record_failure(error, trainer.env_steps)
        trainer.abandon_episodes()


def events_of(folder: RunFolder, trainer: Training) -> TensorBoard | None:
    """What writes the training's events for TensorBoard; None where that isn't installed."""
    if not is_installed():
        return None
    with folder.writing():
        return TensorBoard([folder.path / FOLDER / f"trial-{trial}" for trial in range(folder.config.trials)], trainer)


def draw_results(folder: RunFolder, trainer: Training) -> None:
    """Draw the curve, and what was learnt of the arena, if anything was."""
    config, scenario = folder.config, folder.scenario
    title = f"{scenario.name}, {config.agent} agent, preset {Path(config.preset_name).stem}"
    with folder.writing(), atomic_write(folder.path / "curve.png") as path:
        if trainer.imagination:
            played = played_by(trainer.episode_rows, trainer.evaluation_rows, config.trials)
            draw_played_curve(path, title, played, scenario.optimum)
        else:
            rows = [(row.trial, row.episode, row.score) for row in trainer.evaluation_rows]
            episodes, scores = align_trials(rows, config.trials)
            draw_curve(path, title, episodes, scores, scenario.optimum)
    if trainer.imagination:
        which = f", the first of {config.trials} trials" if config.trials > 1 else ""
        with folder.writing(), atomic_write(folder.path / MAP) as path:
            draw_map(path, title + which, trainer.imagination.seen(0))
