"""``mc-nested doctor``: one table of all that keeps an agent from playing on this computer, and what to do."""

import dataclasses
from collections.abc import Sequence
from functools import partial
from typing import Annotated

import typer
from rich.constrain import Constrain
from rich.table import Table
from rich.text import Text

from calibration.doctor.check import Check, Status
from calibration.doctor.examination import Examination, examine
from calibration.doctor.repair import repair
from calibration.installation.folders import System
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileOption
from mc_nested.cli.output import JsonOption, Output
from mc_nested.live.desktop import open_clipboard

STYLES: dict[Status, str] = {"pass": "green", "warn": "yellow", "fail": "bold red", "skip": "bright_black"}

WIDTH = 100
"""The table's width in columns; less in a narrower terminal."""

FAILED = 1
"""The exit code if a row fails."""


def doctor(
    profile: ProfileOption = None,
    as_json: JsonOption = False,
    fix: Annotated[
        bool,
        typer.Option("--fix", help="mend options.txt and debug-profile.json, with backups; the game must be closed"),
    ] = False,
) -> None:
    """Look at this computer, the game's window and its options: each row with the one thing to do."""
    say = partial(typer.echo, err=True)
    found = _examined(profile)
    if fix and repair(found, say):
        found = _examined(profile)
    rows = [dataclasses.asdict(check) for check in found.checks]
    table = Constrain(table_of(found.checks), WIDTH)
    Output(as_json=as_json).result({"checks": rows}, table, summary_of(found.checks))
    if any(check.status == "fail" for check in found.checks):
        raise typer.Exit(FAILED)


def table_of(checks: Sequence[Check]) -> Table:
    """The rows as a table, with coloured statuses."""
    table = Table(show_edge=False, pad_edge=False)
    for name, ratio in (("check", None), ("", None), ("found", 5), ("to do", 4)):
        table.add_column(name, ratio=ratio, no_wrap=ratio is None, overflow="fold")
    for check in checks:
        cells = (check.name, Text(check.status, STYLES[check.status]), Text(check.detail), Text(check.fix))
        table.add_row(*cells)
    return table


def summary_of(checks: Sequence[Check]) -> str:
    """How many rows have each status."""
    counts = {status: sum(check.status == status for check in checks) for status in STYLES}
    return ", ".join(f"{count} {status}" for status, count in counts.items() if count)


def _examined(profile: str | None) -> Examination:
    say = partial(typer.echo, err=True)
    return examine(
        DEFAULT_PROFILE if profile is None else profile, say=say, system=System.here(), clipboard=open_clipboard()
    )
