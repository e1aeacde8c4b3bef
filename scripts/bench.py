"""Measures one thing, prints its figures, and ends with 1 where one is wrong or misses its target.

python scripts/bench.py NAME [options] [--json]; `python scripts/bench.py NAME --help` lists the options.
"""

import argparse
import importlib
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, cast

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from mc_nested.errors import UserError  # noqa: E402 - found only with the line above

BENCHES = {
    "live": "how exactly and how fast the live path plays on the virtual client",
    "reader": "how exactly and how fast the debug screen is read",
    "calibration": "how well random virtual clients are calibrated unattended",
    "rehearsal": "calibrating and playing in the rehearsal window, in real time",
    "learning": "updates a second, beside loops of a single run",
    "any-design": "how many designs the shipped networks build at the first try",
    "costs": "seconds that the paper's three agents train, by turns",
    "teach": "episodes to the optimum, with a person's build to learn from and without",
    "game-time": "minutes of game time from scratch to the optimum, on the virtual client",
}
"""Each is a module of scripts/benches."""

Figures = Mapping[str, Any]
"""What a bench has measured, as JSON holds it."""


class Bench(Protocol):
    """What each module of scripts/benches holds; its docstring says what is measured and how."""

    __doc__: str | None

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Add the options, with their defaults."""

    def measure(self, options: argparse.Namespace) -> tuple[Figures, bool]:
        """Return figures, and whether they are right: nothing was wrong, every target is met.

        Raises UserError where an option can't be, or something is missing.
        """


def main(words: Sequence[str]) -> int:
    """Run the named bench; 0 if it is right, 1 if not, 2 where an option can't be."""
    names = argparse.ArgumentParser(
        prog="bench.py",
        description=__doc__,
        epilog="\n".join(f"{name:12} {about}" for name, about in BENCHES.items()),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    names.add_argument("name", choices=BENCHES, metavar="NAME")
    name = names.parse_args(words[:1]).name
    bench = cast("Bench", importlib.import_module(f"scripts.benches.{name.replace('-', '_')}"))
    parser = argparse.ArgumentParser(
        prog=f"bench.py {name}", description=bench.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    bench.add_options(parser)
    parser.add_argument("--json", action="store_true", help="print the figures as one JSON object")
    options = parser.parse_args(words[1:])
    try:
        figures, is_right = bench.measure(options)
    except UserError as error:
        parser.error(str(error))
    if options.json:
        print(json.dumps(figures))
    else:
        show(figures, Console())
    return int(not is_right)


def show(figures: Figures, console: Console) -> None:
    """Print the figures as a table, and another for each that holds figures itself."""
    table = Table(show_header=False)
    for name, value in figures.items():
        if not _has_parts(value):
            table.add_row(name, str(value))
    if table.row_count:
        console.print(table)
    for name, value in figures.items():
        for number, part in enumerate(value if isinstance(value, list) else [value] if _has_parts(value) else []):
            if isinstance(part, Mapping):
                console.print(f"{name} {number + 1}" if isinstance(value, list) else name)
                show(part, console)


def _has_parts(value: object) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, list) and any(isinstance(each, Mapping) for each in value))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
