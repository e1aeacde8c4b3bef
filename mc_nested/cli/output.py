"""What verbs say, and to whom: --quiet and --json mean the same for every verb that has them.

Lines for a person go to standard output, progress to standard error. With --quiet only the result is left; with --json
the result is one JSON object (json_fields.py says what is in it), and nothing else goes to standard output.
"""

import contextlib
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import typer
from rich.console import Console, RenderableType

QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="no progress and no hints: only the result")]
JsonOption = Annotated[bool, typer.Option("--json", help="print the result as JSON, and nothing else")]


WIDE = 120
"""Characters a line of a table where no terminal says how many there are."""


@dataclass(frozen=True)
class Output:
    """A verb's output, as --quiet and --json ask for it."""

    quiet: bool = False
    as_json: bool = False

    def note(self, line: str) -> None:
        """A line that can be left out, as where nobody reads any more; with --json it goes to standard error."""
        if not self.quiet:
            with contextlib.suppress(OSError):
                typer.echo(line, err=self.as_json)

    def instruction(self, line: str) -> None:
        """What a person has to do now: it is never left out."""
        typer.echo(line, err=self.quiet or self.as_json)

    def result(self, found: Mapping[str, Any], *lines: RenderableType) -> None:
        """What was asked for: for a program, and the same as lines or tables for a person."""
        if self.as_json:
            typer.echo(json.dumps(_plain(found)))
            return
        console = Console()
        if not console.is_terminal:
            console.width = WIDE
        for line in lines:
            if isinstance(line, str):
                typer.echo(line)
            else:
                console.print(line)

    def hint(self, line: str) -> None:
        """What a person may do next."""
        if not self.as_json:
            self.note(line)

    @property
    def progress(self) -> Console:
        """Where progress is shown."""
        return Console(stderr=True, quiet=self.quiet)


def _plain(found: Any) -> Any:
    """What JSON can hold: paths as text, and null for what is infinite."""
    if isinstance(found, Mapping):
        return {str(key): _plain(value) for key, value in found.items()}
    if isinstance(found, list | tuple):
        return [_plain(value) for value in found]
    if isinstance(found, float):
        return found if math.isfinite(found) else None
    return found if found is None or isinstance(found, bool | int) else str(found)
