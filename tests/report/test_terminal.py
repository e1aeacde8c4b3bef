"""The arena in a terminal: what is where, and a legend."""

import dataclasses

from rich.console import Console

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.report.terminal import arena_view


def test_the_far_edge_is_on_top_and_every_sign_is_explained() -> None:
    console = Console(width=80, record=True, file=None, force_terminal=False, quiet=False)
    with console.capture() as capture:
        console.print(arena_view(load_scenario("line"), (7, 11), {(7, 12), (3, 3)}))
    lines = [line.rstrip() for line in capture.get().splitlines()]
    assert lines[0] == "  . . . . . . . . . . . . . . ."
    assert lines[2] == "  . . . . . . . # . . . . . . ."
    assert lines[3] == "  . . . . . . . ^ . . . . . . ."
    assert lines[4] == "  . . . . . . . o . . . . . . ."
    assert lines[11] == "  . . . x . . . o . . . . . . ."
    for word in ("the agent", "built", "off the design", "still to build"):
        assert word in lines[15]


def test_a_larger_arena_is_shown_whole() -> None:
    corner = dataclasses.replace(load_scenario("line"), design=frozenset({(31, 31)}), start=(0, 0), size=32)
    console = Console(width=80, force_terminal=False)
    with console.capture() as capture:
        console.print(arena_view(corner, (0, 0), ()))
    lines = [line.rstrip() for line in capture.get().splitlines()]
    assert (lines[0], lines[31]) == ("  " + ". " * 31 + "o", "  ^" + " ." * 31)


def test_the_cell_that_is_built_next_has_a_sign_of_its_own_until_something_is_there() -> None:
    console = Console(width=80, force_terminal=False)
    line = load_scenario("line")
    shown = []
    for placed in ((), {(7, 12)}):
        with console.capture() as capture:
            console.print(arena_view(line, (7, 11), placed, (7, 12)))
        shown.append(capture.get().splitlines())
    assert [lines[2].split()[7] for lines in shown] == ["@", "#"]
    assert all("@  next" in lines[15] for lines in shown)
