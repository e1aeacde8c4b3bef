"""``mc-nested train --games``: a training whose episodes are played by games on other computers."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mc_nested.cli.games_at_play import GamesAtPlay, LastEpisode, games_at_play
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.output import Output
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.cli.training import SAVE_EVERY_S, HowToRun, begin_or_resume, draw_results, events_of, published
from mc_nested.cli.training_end import say_end
from mc_nested.cli.training_view import TrainingView
from mc_nested.errors import ClusterError, UserError
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.runs.earlier_run import earlier_run
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.view.publisher import Publisher
from mc_nested.workers.cluster.address import SchedulerAddress, scheduler_address
from mc_nested.workers.games.order import GameOrder
from sim.worlds import Backend

OF_THIS_GAME = ("profile", "server_allowed", "record")
"""Options of this computer's own game, which doesn't play."""


def games_of(
    games: str | None, keys: Path | None, insecure: bool, options: Mapping[str, Any]
) -> SchedulerAddress | None:
    """The scheduler whose games play, None for this computer's; ClusterError or UserError if that can't be."""
    if games is None:
        if keys is not None or insecure:
            raise ClusterError("--keys and --insecure say how games are spoken to: name their scheduler with --games")
        return None
    for name in OF_THIS_GAME:
        if options[name]:
            raise UserError(f"--games play with profiles of their own: leave out --{name.replace('_', '-')}")
    return scheduler_address(games, keys, insecure=insecure)


def run_games_training(
    folder: RunFolder, games: SchedulerAddress, resumed: bool, how: HowToRun, begin_from: Path | None = None
) -> None:
    """Train until the run is finished or somebody stops it; saved on the way and at the end."""
    config, output = folder.config, how.output
    if config.backend == Backend.SIM.value:
        raise UserError("--games are live, or on the virtual client: begin a training with --backend live, or virtual")
    if config.trials != 1:
        raise UserError(f"games teach one trial together, and this training has {config.trials}: leave out --trials")
    earlier = earlier_run(begin_from, folder) if begin_from else None
    began = time.monotonic() - (folder.wall_s_so_far() if resumed else 0.0)
    agent = folder.new_agent(1, config.preset.device)
    trainer = GamesTrainer(folder.scenario, agent, config.preset, config.seed, config.stop_at_optimum)
    order = GameOrder(config.backend, folder.scenario, config.agent, config.preset, config.seed)
    with (
        catch_interrupts() as interrupt,
        published(folder, how) as view,
        games_at_play(games, order, trainer, interrupt, output.note) as play,
    ):
        begin_or_resume(folder, trainer, earlier, resumed)
        output.note(f"run:        {folder.path}")

        choices = 0 if agent.main else len(folder.scenario.materials)
        arenas = LastEpisode(play, folder.scenario, choices)
        shown = TrainingView(view.publisher.board, trainer, folder.scenario, arenas, config)
        training = _GamesTraining(folder, trainer, play, began, shown, view.publisher, interrupt)
        try:
            training.play_until_done(output)
        except ClusterError as error:
            training.save()
            raise ClusterError(f"{error}; saved: go on with mc-nested train --resume {folder.path}") from error
        summary = training.save()
        draw_results(folder, trainer)
        if not trainer.finished:
            raise Stopped(f"stopped and saved: go on with mc-nested train --resume {folder.path}")
    say_end(output, folder.path, config, summary)


@dataclass(frozen=True)
class _GamesTraining:
    """A learner, its games, and who looks on; ``began`` is its time.monotonic()."""

    folder: RunFolder
    trainer: GamesTrainer
    play: GamesAtPlay
    began: float
    shown: TrainingView
    publisher: Publisher
    interrupt: Interrupt

    def save(self) -> dict[str, Any]:
        """Save all: the summary."""
        wall_s = time.monotonic() - self.began - self.publisher.paused_s
        return self.folder.save(self.trainer, wall_s, self.play.summary())

    def play_until_done(self, output: Output) -> None:
        """Look at the games until the training is finished, or somebody stops it; saved now and then."""
        every = SAVE_EVERY_S[Backend(self.folder.config.backend)]
        save_at = time.monotonic() + every
        events = events_of(self.folder, self.trainer)
        with self._progress(output) as progress:
            if not progress.in_terminal:
                self.interrupt.says = STOPPING
            self.shown.show()
            while not (self.trainer.finished or self._is_stopped()):
                for line in self.play.look():
                    progress.say(line)
                progress.show()
                self.shown.show()
                if events:
                    with self.folder.writing():
                        events.write()
                if time.monotonic() >= save_at:
                    self.save()
                    save_at = time.monotonic() + every
                # While a viewer has it paused, the games finish their episodes, and get no others.
                self.publisher.wait_while_paused(self._is_stopped)
            self.play.take_the_last()
        self.shown.show_end()

    def _progress(self, output: Output) -> TrainingProgress:
        scenario = self.folder.scenario
        return TrainingProgress(scenario, self.trainer, output.progress, self._is_stopped, self.play.in_words)

    def _is_stopped(self) -> bool:
        return self.interrupt.requested
