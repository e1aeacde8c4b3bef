"""What every ``mc-nested calibrate`` verb opens: its view, its recording, and the context of the game's window."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

import typer

from calibration.context import OpenContext, context_opener
from calibration.report.page import TITLES
from mc_nested.cli.recording_options import live_recorder
from mc_nested.cli.viewing import viewed
from mc_nested.view.publisher import Publisher

DOCTOR = "looks at this computer and at the game, as mc-nested doctor does"
"""What the guided run does first; its steps have titles. A step can't be paused, since its times are measured."""


@dataclass(frozen=True)
class Calibrating:
    """A calibration that can be viewed: what opens its window, what asks the person, and what publishes it."""

    context_of: OpenContext
    ask: Callable[[str], bool]
    publisher: Publisher


@contextmanager
def calibrating(
    step: str,
    profile: str,
    *,
    is_viewed: bool,
    record: str | None,
    server_allowed: bool = False,
    say: Callable[[str], None] = typer.echo,
    ask: Callable[[str], bool] = typer.confirm,
    yes: bool = False,
) -> Iterator[Calibrating]:
    """A calibration that can be viewed, for the block.

    Args:
        step: the step's name, or "all".
        profile: the profile's name or file.
        is_viewed: whether it is shown in this terminal.
        record: a new folder for the recording, or "off"; None for one among the others.
        server_allowed: whether to calibrate in a game that others may share.
        say: shows the person a line.
        ask: asks the person, where no view can.
        yes: ask nothing, and take yes for the answer.

    Raises:
        RecordingError: the recording's folder holds something already.
    """
    recorder = live_recorder(record, f"calibrate-{step}", server_allowed=server_allowed)
    with viewed(is_viewed, f"calibrate {step}", f"profile {profile}") as viewing:
        board, asks = viewing.publisher.board, partial(viewing.ask, otherwise=ask)
        board.does(TITLES.get(step, DOCTOR))
        board.show(can_pause=step not in TITLES)
        context_of = context_opener(
            say,
            (lambda _: True) if yes else asks,
            is_server_allowed=server_allowed,
            open_recorder=recorder,
            journal=board,
        )
        yield Calibrating(context_of, asks, viewing.publisher)
