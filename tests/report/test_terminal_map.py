"""The map in a terminal: every belief has its sign, and the last built cells show whether they pay."""

from rich.console import Console

from mc_nested.report.terminal import map_view
from tests.report.made_known_arena import made_known_arena


def test_every_belief_and_the_last_built_cells_have_their_signs() -> None:
    console = Console(width=80, force_terminal=False)
    with console.capture() as capture:
        console.print(map_view(made_known_arena()))
    lines = [line.rstrip() for line in capture.get().splitlines()]
    assert lines[:4] == ["  . . . x", "  . . . .", "  . . . .", "  # o ? ."]
    assert lines[4] == "  o pays  - doesn't  ? believed  . unknown  # built, pays  x built elsewhere"
    assert len(lines) == 5


def test_a_narrow_terminal_shows_the_whole_legend_in_two_lines() -> None:
    console = Console(width=50, force_terminal=False)
    with console.capture() as capture:
        console.print(map_view(made_known_arena()))
    lines = [line.rstrip() for line in capture.get().splitlines()]
    assert len(lines) == 6
    for part in ("o pays", "- doesn't", "? believed", ". unknown", "# built, pays", "x built elsewhere"):
        assert part in lines[4] + "\n" + lines[5]
