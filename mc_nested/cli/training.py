"""A training as the command line runs it: begun or resumed, played until it is over, then drawn and printed."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from mc_nested.cli.games_at_play import games_at_play
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.output import Output
from mc_nested.cli.own_player import own_player
from mc_nested.cli.training_end import draw_results, say_end
from mc_nested.cli.training_loop import TrainingLoop
from mc_nested.cli.view import Viewed, viewed
from mc_nested.errors import ClusterError, DesktopError, LiveError
from mc_nested.learn.runs.earlier_run import EarlierRun, earlier_run
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.training import Training
from mc_nested.live.opening import Opening
from mc_nested.report.game_time import expected
from mc_nested.view.status_files import remove_status
from mc_nested.workers.cluster.address import SchedulerAddress
from sim.worlds import Backend, where_words


@dataclass(frozen=True)
class HowToRun:
    """What a run is asked for that its config.toml doesn't say.

    ``opening`` is how a live game is opened; ``games`` have joined that scheduler.
    """

    output: Output
    opening: Opening
    is_viewed: bool = False
    games: SchedulerAddress | None = None


def run_training(folder: RunFolder, resumed: bool, how: HowToRun, begin_from: Path | None = None) -> None:
    """Train until the run is finished or somebody stops it; save it on the way and at the end."""
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
        )
        opened = (
            games_at_play(folder, how.games, interrupt, output.note)
            if how.games
            else own_player(folder, opening, publisher)
        )
        with opened as player:
            begin_or_resume(folder, player.training, earlier, resumed)
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


def begin_or_resume(folder: RunFolder, trainer: Training, earlier: EarlierRun | None, resumed: bool) -> None:
    """Let the trainer go on from the folder's checkpoint; otherwise from an earlier run, if any, in a new folder.

    Raise RunError as ``RunFolder`` and ``EarlierRun`` raise it.
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
    """Yield the run where ``mc-nested view`` finds it; nothing is left of one that never began."""
    title = f"{folder.config.title}, {where_words(Backend(folder.config.backend))}"
    try:
        with viewed(how.is_viewed, "train", title, folder.path) as view:
            yield view
    finally:
        if not folder.has_begun:
            remove_status(folder.path)
