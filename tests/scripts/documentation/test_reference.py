"""The reference of the command line, of the Env and of errors, as the code has them."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import get_args, get_type_hints

import gymnasium
import pytest

from mc_nested import errors
from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv, Info
from mc_nested.arena.rules import PLACES
from mc_nested.cli import app, doctor, interrupt, recordings, replay
from mc_nested.cli.app import VERBS
from mc_nested.entry_point import MadeArenaEnv, made_vector_env
from scripts.documentation.reference import command_line, error_tree


def test_command_line_page_has_a_section_for_every_verb_and_for_calibrate_all() -> None:
    page = command_line()
    assert page.startswith("## `mc-nested`\n")
    assert [f"\n### `mc-nested {verb}`\n" in page for verb in VERBS] == [True] * len(VERBS)
    assert "\n#### `mc-nested calibrate all`\n" in page


def test_an_option_has_its_value_its_meaning_its_default_and_its_limits() -> None:
    page = command_line()
    assert "* `--size WxH`: width and height in pixels  [default: 854x480]\n" in page
    assert "the same seed draws the same mishaps  [default: (a new one); x>=0]\n" in page
    assert "* `RUN <path>`: the folder of a training (its --out)  [required]\n" in page


@pytest.mark.parametrize(
    ("call", "function"), [("make(", MadeArenaEnv), ("make_vec(", made_vector_env)], ids=["make", "make_vec"]
)
def test_every_keyword_of_the_env_is_on_its_page(call: str, function: Callable[..., object]) -> None:
    page = page_of("env")
    assert f"`gymnasium.{call}" in page
    keywords = inspect.signature(function).parameters.values()
    named = [each.name for each in keywords if each.kind is not inspect.Parameter.VAR_KEYWORD]
    assert [f"\n| `{name}` | " in page for name in named] == [True] * len(named)


def test_env_page_has_spaces_actions_info_keys_and_render_modes() -> None:
    page, env = page_of("env"), gymnasium.make("mc_nested/Arena-v0")
    assert f"\n| observation | `{env.observation_space}`" in page
    assert f"\n| action | `{env.action_space}`" in page
    names = [f"{each.name[0]}+D" if each in PLACES else each.name for each in Action]
    assert [f"\n| {number} | `{name}` | " in page for number, name in enumerate(names)] == [True] * len(names)
    for key, kind in get_type_hints(Info).items():
        assert f"\n| `{key}` | `{kind.__name__ if isinstance(kind, type) and not get_args(kind) else kind}` | " in page
    assert all(f'`"{mode}"`' in page for mode in ArenaEnv.metadata["render_modes"])


def test_every_error_is_listed_with_its_base_class() -> None:
    tree = error_tree()
    for name, kind in inspect.getmembers(errors, inspect.isclass):
        assert f"| `{name}` | `{kind.__mro__[1].__name__}` | " in tree
    assert tree.index("`ProfileError`") < tree.index("`DesktopError`") < tree.index("`NoWindowError`")


@pytest.mark.parametrize(
    "code", [doctor.FAILED, replay.DIFFERENT, recordings.DAMAGED, app.MISTAKE, interrupt.INTERRUPTED]
)
def test_every_exit_code_is_on_its_page(code: int) -> None:
    assert f"\n| {code} | " in page_of("errors")


def page_of(name: str) -> str:
    return (Path(__file__).parents[3] / "docs" / "reference" / f"{name}.md").read_text("utf-8")
