"""``mc-nested rehearse``: a window to learn in and to test in, without Minecraft."""

import re
import secrets
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated

import cv2
import typer
from platformdirs import user_data_path

from mc_nested.errors import DesktopError, UserError, with_extra
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.model.debug_entries import on_button, target_entry
from mc_nested.live.model.versions import is_minecrafts
from mc_nested.live.vision.font import font_of, load_font
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.debug_entries import GAME_DEFAULT, DebugEntries, names_block, read_profile
from sim.client.game.edition import Edition
from sim.client.game.options import LARGEST_SCALE, parse_options
from sim.client.settings import ClientSettings, Size
from sim.window.alone import alone_on_this_desktop

SMALLEST: Size = (320, 240)
"""A smaller window has no room for the GUI, at any scale."""

LARGEST: Size = (7680, 4320)

PROFILE = "debug-profile.json"
LOWEST_FPS, HIGHEST_FPS = 5.0, 300.0
LONGEST_LAG_MS = 500.0
SEEDS = 1_000_000
"""One of so many is drawn: six digits are soon typed."""

_VERSION = re.compile(r"1\.(1[2-9]|2[01])(\.[0-9]{1,2})?|26\.[1-4](\.[0-9]{1,2})?")


def rehearse(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    version: Annotated[str, typer.Option(help="the Minecraft version to be like, 1.12 to 26.4")] = "1.20.1",
    size: Annotated[str, typer.Option(metavar="WxH", help="width and height in pixels")] = "854x480",
    gui_scale: Annotated[
        int | None,
        typer.Option(
            min=0, max=LARGEST_SCALE, help="the GUI scale, if it fits; 0 is auto", show_default="what guiScale says"
        ),
    ] = None,
    option: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME=VALUE", help="a line of the game's options.txt, such as toggleUse=true; more than once"
        ),
    ] = None,
    debug_profile: Annotated[
        Path | None,
        typer.Option(
            help="a debug-profile.json: what the debug screen shows from 1.21.9 on", show_default="the game's own"
        ),
    ] = None,
    fps: Annotated[
        float | None,
        typer.Option(min=LOWEST_FPS, max=HIGHEST_FPS, help="frames a second", show_default="the monitor's"),
    ] = None,
    lag: Annotated[
        float, typer.Option(min=0.0, max=LONGEST_LAG_MS, help="milliseconds that keys, and pictures, come late")
    ] = 0.0,
    mishaps: Annotated[
        float, typer.Option(min=0.0, max=60.0, help="how often a minute something goes wrong: a death, a menu, lag ...")
    ] = 0.0,
    seed: Annotated[
        int | None, typer.Option(min=0, help="the same seed draws the same mishaps", show_default="a new one")
    ] = None,
    font: Annotated[
        Path | None, typer.Option(help="a font picture ascii.png, or a client jar", show_default="a font of our own")
    ] = None,
    truth: Annotated[
        Path | None, typer.Option(help="keep the world as it truly is in this JSON file, for tests")
    ] = None,
) -> None:
    """Open a window that looks and acts like the game, to calibrate and train in without Minecraft; close it to end."""
    edition = Edition(_version(version))
    options = parse_options(_lines(option or ()), edition)
    settings = ClientSettings(
        seed=secrets.randbelow(SEEDS) if seed is None else seed,
        version=version,
        size=_size(size),
        scale=options.gui_scale if gui_scale is None else gui_scale,
        font=load_font(font) if font else font_of(drawn_atlas()),
        floor_block="grass_block" if edition.since(1, 13) else "stone",
        options=options,
        debug_entries=_entries(debug_profile, edition),
    )
    if truth is not None and (truth.is_dir() or not truth.parent.is_dir()):
        raise UserError(f"{truth} can't be written: name a file in a folder that exists")
    try:
        from sim.window.rehearsal import Rehearsal, rehearse
    except ImportError as error:
        raise DesktopError(f"the rehearsal window needs more ({error}): {with_extra('rehearse')}") from error

    def explain() -> None:
        pauses = (
            " Press F3+P in the window, or it pauses while another is in front." if options.pause_on_lost_focus else ""
        )
        typer.echo(f"Rehearsing Minecraft {version}.{pauses}")
        if edition.since(1, 21, 9) and not names_block(settings.debug_entries, edition):
            typer.echo("Its debug screen names no block yet, as in the game: press F3+F6 there, type")
            typer.echo(f"{target_entry(version)}, press {on_button(version)}, then Done.")
        typer.echo("To learn calibration, run this in another terminal, and switch to the window:")
        typer.echo(f"  mc-nested calibrate all --profile rehearsal --font {font or _font_picture()}")
        if mishaps:
            typer.echo(f"To draw the same mishaps again: --mishaps {mishaps:g} --seed {settings.seed}")
        typer.echo("Close the window to end.")

    with alone_on_this_desktop(), signals_as_exit():
        rehearse(Rehearsal(settings, fps, lag / 1000, mishaps, truth), explain)


def _version(name: str) -> str:
    if not _VERSION.fullmatch(name) or not is_minecrafts(name):
        raise UserError(f"no version {name!r} can be rehearsed: name one from 1.12 to 26.4, such as 1.20.1")
    return name


def _lines(options: Iterable[str]) -> Iterator[str]:
    """Return the lines of options.txt that these options stand for."""
    for option in options:
        name, equals, value = option.partition("=")
        if not equals:
            raise UserError(f"{option!r} is no option: write NAME=VALUE, such as toggleUse=true")
        yield f"{name}:{value}"


def _entries(path: Path | None, edition: Edition) -> DebugEntries:
    """Return the entries that a debug-profile.json stands for; the game's own without one."""
    if path is None:
        return GAME_DEFAULT
    if not edition.since(1, 21, 9):
        raise UserError(f"Minecraft {edition.version} has no {PROFILE}: it came with 1.21.9")
    try:
        text = path.read_text("utf-8")
    except (OSError, UnicodeError) as error:
        raise UserError(f"{path} can't be read ({error}): name a {PROFILE}") from error
    try:
        return read_profile(text, edition)
    except UserError as error:
        raise UserError(f"{path}: {error}") from error


def _size(text: str) -> Size:
    parts = re.fullmatch(r"([0-9]{1,5})x([0-9]{1,5})", text)
    if parts is None:
        raise UserError(f"no window has the size {text!r}: write width x height in pixels, such as 854x480")
    width, height = int(parts[1]), int(parts[2])
    if width < SMALLEST[0] or height < SMALLEST[1]:
        raise UserError(f"a window of {text} has no room for the game: at least {SMALLEST[0]}x{SMALLEST[1]}")
    if width > LARGEST[0] or height > LARGEST[1]:
        raise UserError(f"no screen is as large as {text}: at most {LARGEST[0]}x{LARGEST[1]}")
    return width, height


def _font_picture() -> Path:
    """Write the project's own font as a picture on disk, for calibrating."""
    path = user_data_path("mc-nested") / "rehearsal-font.png"
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), drawn_atlas())
    return path
