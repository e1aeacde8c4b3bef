"""Tables for a terminal of any width: of many things, where columns are left out, and of the facts of one."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rich.console import Console, ConsoleOptions
from rich.measure import Measurement
from rich.table import Column, Table
from rich.text import Text

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
    """Facts by what they are, one a line; those that say nothing are left out."""
    table = Table(box=None, show_header=False, padding=(0, 2, 0, 0), pad_edge=False)
    for name, value in facts:
        if value:
            table.add_row(name, Text(value))
    return table
