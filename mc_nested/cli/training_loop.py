"""The loop of every training: play on, show it, and save it now and then, until it is finished or stopped."""

import time
from dataclasses import dataclass
from typing import Any, Protocol

from mc_nested.cli.interrupt import Interrupt
from mc_nested.cli.output import Output
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.cli.training_view import Arenas, TrainingView
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.training import Training
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from mc_nested.view.publisher import Publisher
from sim.worlds import Backend

SAVE_EVERY_S = {Backend.SIM: 60.0, Backend.VIRTUAL: 60.0, Backend.LIVE: 15.0}
"""Seconds between checkpoints, which is what a kill can cost: in the simulator, or in a game of a block per second."""


class Player(Protocol):
    """Who plays a training's episodes: this computer (own_player.py), or games elsewhere (games_at_play.py)."""

    @property
    def training(self) -> Training:
        """What is trained."""

    @property
    def arenas(self) -> Arenas:
        """Where, for a view."""

    def play_on(self) -> list[str]:
        """Play on for a moment; return lines about who came and what was lost.

        LiveError, DesktopError or ClusterError if it can't go on.
        """

    def end(self) -> None:
        """Take what is still under way, and play nothing more."""

    def in_words(self) -> str:
        """Return who plays, where there are several; otherwise an empty text."""

    def summary(self) -> dict[str, Any]:
        """Return what playing took, for a training's summary; nothing for the simulator."""


@dataclass(frozen=True)
class TrainingLoop:
    """One training while it runs.

    Args:
        folder: where it is saved.
        player: who plays its episodes.
        publisher: shows it to viewers, who may pause it.
        interrupt: whether somebody asked to stop.
        began: when, on time.monotonic()'s clock.
    """

    folder: RunFolder
    player: Player
    publisher: Publisher
    interrupt: Interrupt
    began: float

    def run(self, output: Output) -> None:
        """Train until it is finished or somebody stops it; errors as ``Player.play_on`` raises them."""
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
