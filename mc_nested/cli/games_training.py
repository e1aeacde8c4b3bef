"""``mc-nested train --games``: a training whose episodes are played by games on other computers."""

import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from mc_nested.cli.earlier_run import earlier_run
from mc_nested.cli.games_at_play import GamesAtPlay, LastEpisode, games_at_play
from mc_nested.cli.interrupt import Interrupt, Stopped, catch_interrupts
from mc_nested.cli.options import Backend
from mc_nested.cli.progress import STOPPING, TrainingProgress
from mc_nested.cli.training import SAVE_EVERY_S, HowToRun, begin_or_resume, draw_results, events_of, published
from mc_nested.cli.training_end import say_end
from mc_nested.cli.training_view import TrainingView
from mc_nested.errors import ClusterError, UserError
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.workers.cluster.address import SchedulerAddress, scheduler_address
from mc_nested.workers.games.order import GameOrder

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
    with catch_interrupts() as interrupt, published(folder, how) as view, games_at_play(games, order, trainer) as play:
        begin_or_resume(folder, trainer, earlier, resumed)
        output.note(f"run:        {folder.path}")

        def save() -> dict[str, Any]:
            wall_s = time.monotonic() - began - view.publisher.paused_s
            return folder.save(trainer, wall_s, play.summary())

        def pause() -> None:
            """While a viewer has it paused, the games finish their episodes, and get no others."""
            view.publisher.wait_while_paused(lambda: interrupt.requested)

        choices = 0 if agent.main else len(folder.scenario.materials)
        arenas = LastEpisode(play, folder.scenario, choices)
        shown = TrainingView(view.publisher.board, trainer, folder.scenario, arenas, config)
        try:
            _play_until_done(folder, trainer, play, shown, how, interrupt, save, pause)
        except ClusterError as error:
            save()
            raise ClusterError(f"{error}; saved: go on with mc-nested train --resume {folder.path}") from error
        summary = save()
        draw_results(folder, trainer)
        if not trainer.finished:
            raise Stopped(f"stopped and saved: go on with mc-nested train --resume {folder.path}")
    say_end(output, folder.path, config, summary)


def _play_until_done(
    folder: RunFolder,
    trainer: GamesTrainer,
    play: GamesAtPlay,
    shown: TrainingView,
    how: HowToRun,
    interrupt: Interrupt,
    save: Callable[[], object],
    pause: Callable[[], None],
) -> None:
    every = SAVE_EVERY_S[Backend(folder.config.backend)]
    save_at = time.monotonic() + every
    events = events_of(folder, trainer)
    view = TrainingProgress(folder.scenario, trainer, how.output.progress, lambda: interrupt.requested, play.in_words)
    with view as progress:
        if not progress.in_terminal:
            interrupt.says = STOPPING
        shown.show()
        while not (trainer.finished or interrupt.requested):
            for line in play.look():
                progress.say(line)
            progress.show()
            shown.show()
            if events:
                with folder.writing():
                    events.write()
            if time.monotonic() >= save_at:
                save()
                save_at = time.monotonic() + every
            pause()
    shown.show_end()
