"""``mc-nested calibrate font``, ``arena``, ``walk`` and ``clicks``: each step of a calibration alone."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.arena.build import calibrate_built_arena
from calibration.arena.mark import mark_arena
from calibration.arena.undo import undo_built_arena
from calibration.clicks.find import calibrate_clicks
from calibration.clicks.points import show_clicks, try_clicks
from calibration.context import OpenContext, context_opener
from calibration.font.find import calibrate_font
from calibration.report.page import TITLES
from calibration.walk.measure import calibrate_walk
from mc_nested.cli.options import (
    DEFAULT_PROFILE,
    ForScenarioOption,
    LayerOption,
    ProfileToWrite,
    RecordOption,
    ServerOption,
    SizeOption,
    StandingOption,
    arena_size,
    opening_of,
)
from mc_nested.cli.view import StepViewOption, viewed
from mc_nested.errors import UserError
from mc_nested.live.session import Opening
from mc_nested.view.publisher import Publisher

DOCTOR = "looks at this computer and at the game, as mc-nested doctor does"
"""What the guided run does first; its steps have titles. A step can't be paused, since its times are measured."""

FontOption = Annotated[
    Path | None, typer.Option(metavar="JAR|PNG", help="take this client jar, resource pack or ascii.png")
]


@dataclass(frozen=True)
class Calibrating:
    """A calibration that can be viewed: what opens its window, what asks the person, and what publishes it."""

    context_of: OpenContext
    ask: Callable[[str], bool]
    publisher: Publisher


@contextmanager
def calibrating(
    step: str,
    opening: Opening,
    *,
    is_viewed: bool,
    ask: Callable[[str], bool] = typer.confirm,
    yes: bool = False,
) -> Iterator[Calibrating]:
    """Yield a calibration that can be viewed, for the block.

    Args:
        step: the step's name, or "all".
        opening: how the game's window is opened.
        is_viewed: whether it is shown in this terminal.
        ask: asks the person, where no view can.
        yes: ask nothing, and take yes for the answer.
    """
    with viewed(is_viewed, f"calibrate {step}", f"profile {opening.profile}") as viewing:
        board, asks = viewing.publisher.board, partial(viewing.ask, otherwise=ask)
        board.does(TITLES.get(step, DOCTOR))
        board.show(can_pause=step not in TITLES)
        context_of = context_opener(replace(opening, journal=board), (lambda _: True) if yes else asks)
        yield Calibrating(context_of, asks, viewing.publisher)


def font(
    profile: ProfileToWrite = DEFAULT_PROFILE,
    font: FontOption = None,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Find the font that your game is written in, and see what is read with it."""
    with calibrating("font", _opening("font", profile, record), is_viewed=view) as opened:
        found, picture = calibrate_font(profile, opened.context_of, font)
    _print([*found.lines, f"compare what is seen with what is read: {picture}"])


def arena(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    profile: ProfileToWrite = DEFAULT_PROFILE,
    font: Annotated[
        Path | None, typer.Option(metavar="PNG|JAR", help="the game's client jar, needed the first time")
    ] = None,
    size: SizeOption = None,
    scenario: ForScenarioOption = None,
    layer: LayerOption = None,
    standing: StandingOption = None,
    yes: Annotated[bool, typer.Option("--yes", help="build, or mark, without asking")] = False,
    mark_only: Annotated[bool, typer.Option("--mark-only", help="type no commands, write only where it is")] = False,
    undo: Annotated[bool, typer.Option("--undo", help="put back what stood there before it was built")] = False,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Build the arena where you stand and look, with commands; what stood there is shown, asked about and copied."""
    if mark_only and undo:
        raise UserError("--mark-only and --undo do different things: choose one of them")
    cells = arena_size(size, scenario, layer)
    opening = _opening("arena", profile, record, server_allowed=server_allowed)
    with calibrating("arena", opening, is_viewed=view) as opened:
        if mark_only:
            ask, say = opened.ask, typer.echo
            path = mark_arena(
                profile, opened.context_of, ask=ask, say=say, size=cells, standing=standing, font=font, yes=yes
            )
            lines = [f"arena written to {path}" if path else "nothing was written"]
        else:
            build = partial(calibrate_built_arena, size=cells, standing=standing, font=font, yes=yes)
            found, file = (undo_built_arena if undo else build)(profile, opened.context_of)
            lines = [*found.lines, *([f"written to {file}"] if file.is_file() else [])]
    _print(lines)


def walk(
    profile: Annotated[
        str, typer.Option(metavar="NAME|FILE", help="the profile to write; it must name the font")
    ] = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Measure how you walk, for a minute, in the marked arena or around where you stand."""
    opening = _opening("walk", profile, record, server_allowed=server_allowed)
    with calibrating("walk", opening, is_viewed=view) as opened:
        found, picture = calibrate_walk(profile, opened.context_of)
    _print([*found.lines, f"written to {profile}; look at the curve in {picture}"])


def clicks(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    points: Annotated[
        list[str] | None,
        typer.Argument(metavar="[POINT]...", help="record these by hand ", show_default="find the menus'"),
    ] = None,
    profile: ProfileToWrite = DEFAULT_PROFILE,
    hotkey: Annotated[str, typer.Option(help="records the place under the mouse")] = "f8",
    skip: Annotated[str, typer.Option(help="leaves a point as it is")] = "f9",
    yes: Annotated[bool, typer.Option("--yes", help="visit the title without asking; nothing by hand")] = False,
    show: Annotated[bool, typer.Option("--show", help="only mark the points on a picture of the screen")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="only move the mouse there, and press nothing")] = False,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Find the places to click in the menus; name points to record those by hand: hover and press the hotkey."""
    if show and dry_run:
        raise UserError("--show and --dry-run do different things: choose one of them")
    with calibrating("clicks", _opening("clicks", profile, record), is_viewed=view, yes=yes) as opened:
        if show:
            lines = [f"look at the points in {show_clicks(profile, opened.context_of)}"]
        elif dry_run:
            lines = try_clicks(profile, opened.context_of)
        else:
            written = calibrate_clicks(
                profile, opened.context_of, names=points or (), is_by_hand=not yes, hotkey=hotkey, skip=skip
            )
            lines = [*written[0].lines, f"look at the points in {written[1]}"] if written else ["nothing was written"]
    _print(lines)


def _opening(step: str, profile: str, record: str | None, *, server_allowed: bool = False) -> Opening:
    return replace(opening_of(profile, f"calibrate-{step}", record, server_allowed=server_allowed), say=typer.echo)


def _print(lines: Iterable[str]) -> None:
    for line in lines:
        typer.echo(line)
