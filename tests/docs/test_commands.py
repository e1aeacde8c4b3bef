"""Every command, program and file of README and of docs/ is followed, page by page, as a reader would.

Long ones have their smallest sizes (rules.py); live ones play on the virtual desktop, or in a real rehearsal window.
"""

import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from scripts.window_display import open_display
from tests.docs.pages import Step, inline_commands, pages, steps_of
from tests.docs.reader import Reader, not_shown, what_is_wrong
from tests.docs.rules import BEFORE, IN_A_WINDOW, LIVE_SNIPPET, NEEDS, what_it_does
from tests.docs.shell import StepError

if not sys.platform.startswith("linux"):
    pytest.skip("the commands of a Linux shell", allow_module_level=True)


def test_not_shown_finds_the_first_line_that_was_not_printed() -> None:
    printed = "  first line  \nfinal scores (optimum 21): 19.5, 21\nlast\n"
    assert not_shown("final scores (optimum 21): …\nlast", printed) is None
    assert not_shown("  first line\n\nlast\n", printed) is None
    assert not_shown("final   scores (optimum 21): …", printed) is None
    assert not_shown("last\nfinal scores …", printed) == "final scores …"  # in another order
    assert not_shown("final scores", printed) == "final scores"


@pytest.mark.parametrize(
    ("figures", "wrong"),
    [
        ({"60 fps": {"actions": 4, "wrong_cells": 0, "wrong_blocks": 0}}, []),
        ({"60 fps": {"actions": 4, "wrong_cells": 1, "wrong_blocks": 0}}, ["wrong_cells"]),
        ({"60 fps": {"problem": "no window"}}, ["problem"]),
        ({"wrong": 0, "replay": [{"differences": []}, {"differences": [{"action": 1}]}]}, ["differences"]),
    ],
)
def test_wrong_figures_of_a_benchmark_are_found(figures: object, wrong: list[str]) -> None:
    assert what_is_wrong(figures) == wrong


def test_command_without_a_rule_is_an_error_that_names_it(tmp_path: Path) -> None:
    unknown = Step("docs/page.md", 3, "command", "make me a sandwich")
    with Reader(tmp_path) as reader, pytest.raises(StepError, match=r"docs/page.md:3: make me a sandwich\nno rule"):
        reader.follow(unknown)


@pytest.mark.slow
def test_command_that_fails_is_an_error_with_its_exit_code_and_output(tmp_path: Path) -> None:
    wrong = Step("docs/page.md", 3, "command", "mc-nested scenarios no-such-design")
    with Reader(tmp_path) as reader, pytest.raises(StepError, match="exit code 2:\nmc-nested: no scenario"):
        reader.follow(wrong)


@pytest.mark.slow
def test_program_that_fails_in_the_game_is_an_error_with_its_page_and_line(tmp_path: Path) -> None:
    wrong = Step("docs/page.md", 3, "snippet", f'make = dict({LIVE_SNIPPET})\nmake["scenario"]\n')
    with Reader(tmp_path) as reader, pytest.raises(StepError, match=r"(?s)docs/page.md:3: .*KeyError: 'scenario'"):
        reader.follow(wrong)


def opens_a_window(page: str) -> bool:
    return any(step.text.startswith("mc-nested rehearse") for step in steps_of(page))


def follow(reader: Reader, page: str) -> None:
    for command in NEEDS.get(page, ()):
        reader.follow(Step(page, 0, "command", command))
    if page in NEEDS:
        reader.take_screenshot("screenshot.png")
    for step in steps_of(page):
        reader.follow(step)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in pages() if steps_of(page) and not opens_a_window(page)])
def test_a_page_can_be_followed(page: str, tmp_path: Path) -> None:
    with Reader(tmp_path) as reader:
        follow(reader, page)


def of_figures() -> list[Step]:
    """Return the commands in texts and tables that stand in no block: those of figures, and mentions."""
    in_blocks = {what_it_does(step.text) for page in pages() for step in steps_of(page) if step.kind == "command"}
    inline = {what_it_does(step.text): step for page in pages() for step in inline_commands(page)}
    return [step for does, step in inline.items() if does not in in_blocks]


def mark_of(step: Step) -> pytest.MarkDecorator:
    """Return what a command needs."""
    return pytest.mark.window if step.text.startswith(IN_A_WINDOW) else pytest.mark.slow


@pytest.mark.parametrize("step", [pytest.param(step, id=step.text, marks=mark_of(step)) for step in of_figures()])
def test_a_command_in_a_text_or_table_can_be_run(step: Step, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    if step.text.startswith(IN_A_WINDOW):
        request.getfixturevalue("window_programs")
    with Reader(tmp_path) as reader:
        for command in BEFORE.get(step.text, ()):
            reader.follow(Step(step.page, step.line, "command", command))
        reader.follow(step)


@pytest.fixture
def displays(window_programs: None) -> Iterator[ExitStack]:  # noqa: ARG001 - installs what is missing
    with ExitStack() as opened:
        yield opened


@pytest.mark.window
@pytest.mark.parametrize("page", [page for page in pages() if opens_a_window(page)])
def test_a_page_that_opens_a_window_can_be_followed(page: str, tmp_path: Path, displays: ExitStack) -> None:
    with Reader(tmp_path, lambda: displays.enter_context(open_display())) as reader:
        follow(reader, page)
