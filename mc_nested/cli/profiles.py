"""``mc-nested profiles``: list your profiles, look at one, rename it, delete it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from calibration.profiles import (
    ProfileFacts,
    delete_profile,
    facts_of,
    files_of,
    holds_a_copy,
    named_profile,
    named_profiles,
    names_of,
    rename_profile,
)
from mc_nested.cli.completion import complete_profiles
from mc_nested.cli.options import is_alone
from mc_nested.cli.output import FittingTable, JsonOption, Output, facts_table, prints
from mc_nested.errors import DesktopError
from mc_nested.live.desktop import open_camera, this_system
from mc_nested.live.desktop.display import WindowDisplay
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.vision.layout import Scales

app = typer.Typer()

NameArgument = Annotated[str, typer.Argument(metavar="PROFILE", help="its name", autocompletion=complete_profiles)]


@dataclass(frozen=True)
class ProfileList:
    """What ``profiles list`` prints."""

    folder: Annotated[Path, "of all profiles"]
    profiles: Annotated[Sequence[ProfileFacts], "as of profiles show, without files"]


@dataclass(frozen=True)
class ProfileShown(ProfileFacts):
    """What ``profiles show`` prints."""

    files: Annotated[Sequence[Path], "all that belong to it"] = ()


@app.callback(invoke_without_command=True)
def profiles(context: typer.Context, as_json: JsonOption = False) -> None:
    """List your profiles, look at one, rename it, delete it; alone it lists them."""
    if is_alone(context):
        list_profiles(as_json)


@app.command("list")
@prints(ProfileList)
def list_profiles(as_json: JsonOption = False) -> None:
    """List your profiles, with what each was calibrated on, and whether it fits the open window."""
    found = [facts_of(file, window_of) for file in named_profiles()]
    lines = [f"{each.name}: {each.why}" for each in found if each.is_damaged or each.fits is False]
    folder = profile_folder()
    shown = [_table(found), *lines] if found else [f"no profiles in {folder}: mc-nested calibrate all makes one"]
    Output(as_json=as_json).result(ProfileList(folder, found), *shown)


@app.command()
@prints(ProfileShown)
def show(profile: NameArgument, as_json: JsonOption = False) -> None:
    """Show one profile: its file, what it was calibrated on, whether it fits the open window."""
    file = named_profile(profile)
    facts, files = facts_of(file, window_of), files_of(file)
    rows = (*_facts(facts), ("why", facts.why or ""), ("file", str(file)), ("all files", names_of(files)))
    Output(as_json=as_json).result(ProfileShown(**vars(facts), files=files), facts_table(rows))


@app.command()
def rename(profile: NameArgument, name: Annotated[str, typer.Argument(metavar="NAME", help="its new name")]) -> None:
    """Give a profile another name, with all its files."""
    typer.echo(f"renamed to {rename_profile(named_profile(profile), name)}")
    typer.echo(f"a run that was trained with {profile} goes on with --resume RUN --profile {name}")


@app.command()
def delete(
    profiles: Annotated[
        list[str], typer.Argument(metavar="PROFILE...", help="their names", autocompletion=complete_profiles)
    ],
    yes: Annotated[bool, typer.Option("--yes", help="delete without asking")] = False,
) -> None:
    """Delete profiles with all their files, after a question for each."""
    for file in [named_profile(name) for name in profiles]:
        if holds_a_copy(file):
            typer.echo(
                f"{file.stem} knows where the copy is of what stood where its arena is; "
                f"mc-nested calibrate arena --undo --profile {file.stem} puts that back, and can't afterwards"
            )
        if yes or typer.confirm(f"Delete {file.stem} ({names_of(files_of(file))})?"):
            delete_profile(file)
            typer.echo(f"deleted {file.stem}")
        else:
            typer.echo(f"kept {file.stem}")


def window_of(title: str) -> Fingerprint | None:
    """Return the open window in whose title that regular expression is found; None if there is none, or no desktop."""
    try:
        with this_system().open_window(title) as window, open_camera(window) as camera:
            display = WindowDisplay(window, camera)
            return Fingerprint(display.title(), display.size())
    except DesktopError:
        return None


def _table(found: Sequence[ProfileFacts]) -> FittingTable:
    return FittingTable([{name: Text(value, _style(name, value)) for name, value in _facts(facts)} for facts in found])


def _style(name: str, value: str) -> str:
    return {"yes": "green", "unknown": "yellow"}.get(value, "bold red") if name == "fits" else ""


def _facts(facts: ProfileFacts) -> list[tuple[str, str]]:
    """Return the facts in words, by their names."""
    gui, debug, cells = facts.gui_scale, facts.debug_scale, facts.arena_size
    fits = "damaged" if facts.is_damaged else {True: "yes", False: "no", None: "unknown"}[facts.fits]
    return [
        ("profile", facts.name),
        ("version", facts.version or ""),
        ("window", f"{facts.window[0]} x {facts.window[1]}" if facts.window else ""),
        ("GUI scale", str(Scales(gui, debug)) if gui and debug else ""),
        ("arena", f"{cells} x {cells}" if cells else ""),
        ("calibrated", facts.date or ""),
        ("fits", fits),
    ]
