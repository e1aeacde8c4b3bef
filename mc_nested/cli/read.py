"""``mc-nested read``: what pictures of the debug screen say."""

from pathlib import Path
from typing import Annotated, Any

import typer

from mc_nested.cli.output import JsonOption, Output
from mc_nested.errors import FontError, PictureError
from mc_nested.live.model.debug_entries import GROUND_PITCH_DEG, switch_on
from mc_nested.live.profile.overlay import overlay_of
from mc_nested.live.profile.store import load_profile
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.read_pictures import read_picture


def read(
    images: Annotated[list[Path], typer.Argument(metavar="IMAGE...", help="screenshots with the debug screen on")],
    font: Annotated[
        Path | None, typer.Option(metavar="PNG|JAR", help="the game's ascii.png, client jar or a resource pack")
    ] = None,
    profile: Annotated[
        str | None, typer.Option(metavar="NAME|FILE", help="take font and overlay from a profile")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Read pictures of the debug screen: position, view and the block looked at; with --json a line a picture.

    A file that is no picture ends it with exit code 2, once the others are read.
    """
    output = Output(as_json=as_json)
    known = load_profile(profile) if profile else None
    if font is None:
        if known is None:
            raise FontError(
                "name the game's font: --font with its client jar or ascii.png, or --profile with one that has it"
            )
        font = known.screen.font_path()
    glyphs = load_font(font.expanduser())
    overlay = overlay_of(known) if known else None
    unusable: list[PictureError] = []
    for image in images:
        try:
            found = read_picture(image, glyphs, overlay)
        except PictureError as error:
            unusable.append(error)
            continue
        output.result(found, _line(found))
    if unusable:
        count = len(unusable) - 1
        others = f"; {count} other file{'s' if count > 1 else ''} can't be read either" if count else ""
        raise PictureError(f"{unusable[0]}{others}")


def _line(found: dict[str, Any]) -> str:
    if found["xyz"] is None:
        return f"{found['file']}: unread: {found['problem']}"
    position = " ".join(f"{value:.3f}" for value in found["xyz"])
    target = found["target"]
    target_block = f"looks at {target['id']} {target['pos']}" if target else "looks at no block"
    if target is None and found["pitch"] >= GROUND_PITCH_DEG:
        target_block += f": if the ground is in view, that line is off: {switch_on(None)}"
    return f"{found['file']}: at {position}, yaw {found['yaw']}, pitch {found['pitch']}, {target_block}"
