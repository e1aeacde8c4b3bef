"""The reference of the command line, of the Env and of errors, as the code has them."""

import inspect
from pathlib import Path

import pytest

from mc_nested import errors
from mc_nested.cli import app, doctor, interrupt, recordings, replay
from mc_nested.cli.app import VERBS
from scripts.documentation.reference import command_line, env, error_tree


def test_every_verb_is_there_and_those_below_it() -> None:
    page = command_line()
    assert page.startswith("## `mc-nested`\n")
    assert [f"\n### `mc-nested {verb}`\n" in page for verb in VERBS] == [True] * len(VERBS)
    assert "\n#### `mc-nested calibrate all`\n" in page


def test_an_option_has_its_value_its_meaning_its_default_and_its_limits() -> None:
    page = command_line()
    assert "* `--size WxH`: width and height in pixels  [default: 854x480]\n" in page
    assert "the same seed draws the same mishaps (default: a new one)  [x>=0]\n" in page
    assert "* `RUN <path>`: the folder of a training (its --out)  [required]\n" in page


def test_the_env_says_what_goes_in_and_what_comes_out() -> None:
    page = env()
    assert "| `scenario` |" in page
    assert "| action | `Discrete(8)` |" in page
    assert "| 7 | `B+D` | a cell back, then a block in front of the agent |" in page
    assert "| `placed` | `tuple[int, int]` | Where a block landed; not there if none did. |" in page
    assert "Render modes: `rgb_array`, `ansi`." in page


def test_every_error_is_below_the_one_that_it_is_a_kind_of() -> None:
    tree = error_tree()
    for name, kind in inspect.getmembers(errors, inspect.isclass):
        assert f"| `{name}` | `{kind.__mro__[1].__name__}` | " in tree
    assert tree.index("`ProfileError`") < tree.index("`DesktopError`") < tree.index("`NoWindowError`")


@pytest.mark.parametrize(
    "code", [doctor.FAILED, replay.DIFFERENT, recordings.DAMAGED, app.MISTAKE, interrupt.INTERRUPTED]
)
def test_every_exit_code_is_on_its_page(code: int) -> None:
    page = Path(__file__).parents[3] / "docs" / "reference" / "errors.md"
    assert f"\n| {code} | " in page.read_text("utf-8")
