"""A line of progress where there is no terminal."""

import contextlib

from rich.console import Console


def print_line(console: Console, line: str) -> None:
    """Print it whole. Where nobody reads any more, as behind a pipe after Ctrl+C, the work goes on, and is saved."""
    if console.quiet:
        return
    with contextlib.suppress(OSError):
        print(line, file=console.file, flush=True)
