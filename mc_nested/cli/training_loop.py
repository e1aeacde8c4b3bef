"""A training as the command line runs it: begun or resumed, played and saved until its end, drawn and printed."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.demonstration import Demonstration
from mc_nested.arena.game import PlayLog
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.cli.games_at_play import GamesAtPlay, games_at_play
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.output import Output
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.cli.training_end import draw_results, say_end
from mc_nested.cli.training_view import TrainingView
from mc_nested.cli.view import Viewed, viewed
from mc_nested.errors import ClusterError, DesktopError, LiveError, NotInFrontError, TakenOverError
from mc_nested.learn.objective_training import ObjectivesTraining
from mc_nested.learn.runs.earlier_run import EarlierRun, earlier_run
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.training import Training
from mc_nested.learn.whole_episode import as_seen
from mc_nested.live.action_log import FailureBudget
from mc_nested.live.input.stops import Takeover
from mc_nested.live.session import Opening
from mc_nested.report.game_time import expected
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from mc_nested.view.files import remove_status
from mc_nested.view.publisher import Publisher
from mc_nested.workers.cluster.address import SchedulerAddress
from sim.grid import GridVectorEnv
from sim.team_grid import team_arenas
from sim.worlds import Backend, as_shown, open_arenas, where_words

SAVE_EVERY_S = {Backend.SIM: 60.0, Backend.VIRTUAL: 60.0, Backend.LIVE: 15.0}
"""Seconds between checkpoints, which is what a kill can cost: in the simulator, or in a game of a block per second."""


@dataclass(frozen=True)
class OwnPlayer:
    """A trainer and its arenas here; ``log`` says what playing took, None of the simulator."""

    training: Trainer | ObjectivesTraining
    arenas: GridVectorEnv | ArenaVectorEnv | TeamVectorEnv
    log: PlayLog | None
    was_paused_lately: Callable[[], bool]
    failures: FailureBudget = field(default_factory=FailureBudget)

    def play_on(self) -> list[str]:
        """Play one tick, and return the practice's news. A mishap in a running game costs its episode, and is counted.

        A person in another window who pauses, or did so shortly before, is not counted as a mishap, nor is one who has
        taken over when the run is stopped.
        """
        try:
            self.training.tick()
        except DesktopError:
            self.training.abandon_episodes()
            raise
        except LiveError as error:
            self.training.abandon_episodes()
            is_left = isinstance(error, NotInFrontError) and self.was_paused_lately()
            if not (is_left or isinstance(error, TakenOverError)):
                self.failures.record_failure(error, self.training.env_steps)
                return [f"{error}; the episode starts over", *self.training.practice.news()]
        return self.training.practice.news()

    def end(self) -> None:
        """Do nothing: what is under way is saved half-way, or starts over."""

    def in_words(self) -> str:
        """Return an empty text: this computer alone plays."""
        return ""

    def summary(self) -> dict[str, Any]:
        """Return what playing in a running game, or on the virtual client, took; nothing for the simulator."""
        return {"live": {**self.log.summary(), **self.failures.summary()}} if self.log else {}


@contextmanager
def own_player(folder: RunFolder, opening: Opening, publisher: Publisher) -> Iterator[OwnPlayer]:
    """Yield an untrained trainer for that folder's training, in arenas that are open for the block.

    Errors as ``open_arenas`` raises them.
    """
    config = folder.config
    with open_arenas(Backend(config.backend), folder.scenarios, opening, config.seed) as (opened, log):
        env = team_arenas(folder.team, config.trials) if folder.team else opened
        agent = folder.new_agent(config.trials, config.preset.device)
        shown = env if isinstance(env, TeamVectorEnv) else as_shown(env, config.preset.states)
        view = agent.view_of(shown, folder.scenarios)
        asked = folder.scenarios, agent, config.preset, config.seed, config.stop_at_optimum
        trainer = ObjectivesTraining(*asked) if config.trains_objectives else Trainer(view, *asked)
        yield OwnPlayer(trainer, env, log, lambda: publisher.was_paused_lately)


@dataclass(frozen=True)
class TrainingLoop:
    """One training while it runs.

    Args:
        folder: where it is saved.
        player: who plays its episodes: this computer, or games elsewhere.
        publisher: shows it to viewers, who may pause it.
        interrupt: whether somebody asked to stop.
        began: when, on time.monotonic()'s clock.
    """

    folder: RunFolder
    player: OwnPlayer | GamesAtPlay
    publisher: Publisher
    interrupt: Interrupt
    began: float

    def run(self, output: Output) -> None:
        """Train until it is finished or somebody stops it; errors as its player's ``play_on`` raises them."""
        training, player, config = self.player.training, self.player, self.folder.config
        every = SAVE_EVERY_S[Backend(config.backend)]
        save_at = time.monotonic() + every
        events = self._events()
        shown = TrainingView(self.publisher.board, training, self.folder.scenario, player.arenas, config)
        progress = TrainingProgress(self.folder.scenario, training, output.progress, self._is_stopped, player.in_words)
        with progress:
            if not progress.in_terminal:
                self.interrupt.says = STOPPING
            shown.show()
            while not (training.finished or self._is_stopped()):
                for line in player.play_on():
                    progress.say(line)
                progress.show()
                shown.show()
                if events:
                    with self.folder.writing():
                        events.write()
                if time.monotonic() >= save_at:
                    self.save()
                    save_at = time.monotonic() + every
                if not training.finished:
                    self.publisher.wait_while_paused(self._is_stopped)
            player.end()
        shown.show_end()

    def save(self) -> dict[str, Any]:
        """Save the training as it is now, and return its summary."""
        wall_s = time.monotonic() - self.began - self.publisher.paused_s
        return self.folder.save(self.player.training, wall_s, self.player.summary())

    def _is_stopped(self) -> bool:
        return self.interrupt.requested

    def _events(self) -> TensorBoard | None:
        """Return what writes the training's events for TensorBoard; None where that isn't installed."""
        if not is_installed():
            return None
        trials = range(self.folder.config.trials)
        with self.folder.writing():
            folders = [self.folder.path / FOLDER / f"trial-{trial}" for trial in trials]
            return TensorBoard(folders, self.player.training)


@dataclass(frozen=True)
class HowToRun:
    """What a run is asked for that its config.toml doesn't say.

    ``opening`` is how a live game is opened; ``games`` have joined that scheduler.
    """

    output: Output
    opening: Opening
    is_viewed: bool = False
    games: SchedulerAddress | None = None


def run_training(
    folder: RunFolder,
    resumed: bool,
    how: HowToRun,
    begin_from: Path | None = None,
    shown: Sequence[Demonstration] = (),
) -> None:
    """Train until the run is finished or somebody stops it; save it on the way and at the end.

    A new training begins from an earlier run, and learns from the episodes that were ``shown``.
    """
    config, output, path = folder.config, how.output, folder.path
    earlier = earlier_run(begin_from, folder) if begin_from else None
    began = time.monotonic() - (folder.wall_s_so_far() if resumed else 0.0)
    with catch_interrupts() as interrupt, published(folder, how) as view:
        publisher = view.publisher
        opening = replace(
            how.opening,
            what=f"train-{folder.scenario.name}",
            evidence=path / "evidence",
            journal=publisher.board,
            takeover=Takeover(publisher.offer_takeover, lambda: interrupt.requested),
        )
        opened = (
            games_at_play(folder, how.games, interrupt, output.note)
            if how.games
            else own_player(folder, opening, publisher)
        )
        with opened as player:
            begin_or_resume(folder, player.training, earlier, shown, resumed)
            if not resumed and Backend(config.backend) is Backend.LIVE and not how.games:
                expectation = expected(config.preset, folder.scenario, stop_at_optimum=config.stop_at_optimum)
                output.note(expectation.line(folder.scenario))
            output.note(f"run:        {path}")
            loop = TrainingLoop(folder, player, publisher, interrupt, began)
            try:
                loop.run(output)
            except (LiveError, DesktopError, ClusterError) as error:
                loop.save()
                kind = ClusterError if isinstance(error, ClusterError) else LiveError
                raise kind(f"{error}; saved: go on with mc-nested train --resume {path}") from error
            publisher.board.does("saves, and draws its curve")
            summary = loop.save()
        draw_results(folder, player.training)
        if not player.training.finished:
            raise Stopped(f"stopped and saved: go on with mc-nested train --resume {path}")
    say_end(output, path, config, summary)


def begin_or_resume(
    folder: RunFolder, trainer: Training, earlier: EarlierRun | None, shown: Sequence[Demonstration], resumed: bool
) -> None:
    """Let the trainer go on from the folder's checkpoint; otherwise begin in a new folder, with what it is given.

    Raise RunError as ``RunFolder`` and ``EarlierRun`` raise it.
    """
    if resumed:
        folder.checkpoint.load_into(trainer)
        return
    if earlier:
        earlier.begin(trainer)
    for each in shown:
        trainer.learn_from(as_seen(trainer.agent, folder.scenario, each))
    if earlier or shown:
        folder.save_before_all(trainer)
    folder.begin()


@contextmanager
def published(folder: RunFolder, how: HowToRun) -> Iterator[Viewed]:
    """Yield the run where ``mc-nested view`` finds it; nothing is left of one that never began."""
    title = f"{folder.config.title}, {where_words(Backend(folder.config.backend))}"
    try:
        with viewed(how.is_viewed, "train", title, folder.path) as view:
            yield view
    finally:
        if not folder.has_begun:
            remove_status(folder.path)
