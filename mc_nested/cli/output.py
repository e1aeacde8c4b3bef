"""What verbs say, and to whom: --quiet and --json mean the same for every verb that has them.

Lines for a person go to standard output, progress to standard error. With --quiet only the result is left; with --json
the result is one JSON object, and nothing else goes to standard output. A verb's result is a dataclass, whose fields
are ``Annotated`` with what they mean: the verb's help lists them, and scripts may rely on them. A field keeps its name
and meaning; new ones may come. Paths are text, times seconds, sizes bytes; null is unknown.
"""

import contextlib
import dataclasses
import datetime
import json
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, TypeVar, get_type_hints

import typer
from rich.console import Console, ConsoleOptions, RenderableType
from rich.measure import Measurement
from rich.table import Column, Table
from rich.text import Text

QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="no progress and no hints: only the result")]
JsonOption = Annotated[bool, typer.Option("--json", help="print the result as JSON, and nothing else")]

WIDE = 120
"""Characters a line of a table where no terminal says how many there are."""

Verb = TypeVar("Verb", bound=Callable[..., None])


def prints(result: type) -> Callable[[Verb], Verb]:
    """Say which dataclass is a verb's result."""

    def said(verb: Verb) -> Verb:
        verb.prints = result  # type: ignore[attr-defined]  # Typer keeps it on the command's callback
        return verb

    return said


def json_fields(verb: Any) -> dict[str, str]:
    """Say what each field of a verb's result means; nothing for a verb without --json."""
    result = getattr(verb, "prints", None)
    if result is None:
        return {}
    hints = get_type_hints(result, include_extras=True)
    return {field.name: hints[field.name].__metadata__[0] for field in dataclasses.fields(result)}


def epilog_of(verb: Any) -> str | None:
    """Write the last paragraph of a verb's --help; None for one without --json."""
    fields = json_fields(verb)
    if not fields:
        return None
    return f"--json prints {'; '.join(f'{name}: {meaning}' for name, meaning in fields.items())}."


@dataclass(frozen=True)
class Output:
    """A verb's output, as --quiet and --json ask for it."""

    quiet: bool = False
    as_json: bool = False

    def note(self, line: str) -> None:
        """Print a line that can be left out, as where nobody reads any more; with --json it goes to standard error."""
        if not self.quiet:
            with contextlib.suppress(OSError):
                typer.echo(line, err=self.as_json)

    def instruction(self, line: str) -> None:
        """Print what a person has to do now: it is never left out."""
        typer.echo(line, err=self.quiet or self.as_json)

    def result(self, found: Any, *lines: RenderableType) -> None:
        """Print what was asked for: a dataclass for a program, and the same as lines or tables for a person."""
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
        """Print what a person may do next."""
        if not self.as_json:
            self.note(line)

    @property
    def progress(self) -> Console:
        """Where progress is shown."""
        return Console(stderr=True, quiet=self.quiet)


def say_aside(line: str) -> None:
    """Show a line on standard error, above what a terminal shows of the run: Typer would write into that."""
    print(line, file=sys.stderr, flush=True)


def print_line(console: Console, line: str) -> None:
    """Print a line of progress where there is no terminal, whole.

    If the reader is gone, as behind a pipe after Ctrl+C, the work goes on, and is saved.
    """
    if console.quiet:
        return
    with contextlib.suppress(OSError):
        print(line, file=console.file, flush=True)


def _plain(found: Any) -> Any:
    """Return a value as JSON can hold it: a dataclass as an object, a path as text, and what is infinite as null."""
    if dataclasses.is_dataclass(found):
        return {field.name: _plain(getattr(found, field.name)) for field in dataclasses.fields(found)}
    if isinstance(found, Mapping):
        return {str(key): _plain(value) for key, value in found.items()}
    if isinstance(found, list | tuple):
        return [_plain(value) for value in found]
    if isinstance(found, float):
        return found if math.isfinite(found) else None
    if isinstance(found, datetime.datetime):
        return found.isoformat(timespec="seconds")
    return found if found is None or isinstance(found, bool | int) else str(found)


ANY_WIDTH = 10_000


@dataclass(frozen=True)
class FittingTable:
    """Rows of cells by their column.

    Args:
        rows: the cells, in the order of the columns.
        left_out: columns that can be missing, the least needed first.
        numbers: columns that are aligned to the right.
    """

    rows: Sequence[Mapping[str, Text]]
    left_out: Sequence[str] = ()
    numbers: Sequence[str] = ()

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Table]:
        for count in range(len(self.left_out) + 1):
            table = self._without(self.left_out[:count])
            if Measurement.get(console, options.update_width(ANY_WIDTH), table).maximum <= options.max_width:
                break
        yield table

    def _without(self, left_out: Sequence[str]) -> Table:
        heads = [head for head in self.rows[0] if head not in left_out]
        columns = (Column(head, justify="right" if head in self.numbers else "left", overflow="fold") for head in heads)
        table = Table(*columns, box=None, padding=(0, 2, 0, 0), pad_edge=False)
        for row in self.rows:
            table.add_row(*(row[head] for head in heads))
        return table


def facts_table(facts: Iterable[tuple[str, str]]) -> Table:
    """Return a table of named facts, one a line; empty ones are left out."""
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
    for name, value in facts:
        if value:
            table.add_row(name, Text(value))
    return table
