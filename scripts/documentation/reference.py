"""The reference, made from the code: the command line, the Env, and the tree of errors."""

import ast
import inspect
from collections.abc import Callable
from itertools import pairwise
from typing import get_type_hints

import gymnasium
import typer
from typer.cli import get_docs_for_click
from typer.main import get_command

from mc_nested import errors
from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv, Info
from mc_nested.arena.rules import PLACES, STEP
from mc_nested.cli.app import app_for
from mc_nested.entry_point import MadeArenaEnv, made_vector_env
from scripts.documentation.markdown_text import code, of_docstring, table

ENV = "mc_nested/Arena-v0"

MADE_BY: dict[str, Callable[..., object]] = {
    f'gymnasium.make("{ENV}", …)': MadeArenaEnv,
    f'gymnasium.make_vec("{ENV}", …)': made_vector_env,
}
"""Each call, and what takes its keywords."""

WAYS = {(0, 1): "forward", (0, -1): "back", (-1, 0): "to the left", (1, 0): "to the right"}


def command_line() -> str:
    """Describe every verb, argument and option, as Typer does it."""
    command = get_command(app_for(()))
    return get_docs_for_click(obj=command, ctx=typer.Context(command), name="mc-nested", indent=1)


def env() -> str:
    """Describe what gymnasium.make and gymnasium.make_vec take and return."""
    made = gymnasium.make(ENV)
    parts = ["## Making it\n"]
    for call, function in MADE_BY.items():
        keywords = inspect.signature(function).parameters.values()
        rows = [[code(each.name), code(_plain(each.annotation)), code(repr(each.default))] for each in keywords]
        parts += [f"`{call}` takes\n", table(["keyword", "type", "left out"], rows)]
    spaces = [["observation", code(str(made.observation_space))], ["action", code(str(made.action_space))]]
    parts += ["## Spaces\n", "Of the design `line`; x and y grow with the arena, b with the design's blocks.\n"]
    parts += [table(["", "space"], spaces), "An observation is x, y and b, the blocks left.\n"]
    actions = [[str(int(each)), code(_name(each)), _words(each)] for each in Action]
    parts += ["## Actions\n", table(["number", "name", "what it does"], actions)]
    parts += ["## Reward, end and reset\n", of_docstring(inspect.getdoc(ArenaEnv)) + "\n"]
    hints, docs = get_type_hints(Info), _docs_below_fields(Info)
    parts += ["## info\n", of_docstring(inspect.getdoc(Info)) + "\n"]
    parts += [table(["key", "type", "what it is"], ([code(key), code(_plain(hints[key])), docs[key]] for key in hints))]
    modes = ", ".join(code(mode) for mode in ArenaEnv.metadata["render_modes"])
    parts += ["## Pictures\n", f"Render modes: {modes}. {of_docstring(inspect.getdoc(ArenaEnv.render))}\n"]
    return "\n".join(parts)


def error_tree() -> str:
    """Describe every error that is raised on purpose, below the one that it is a kind of."""
    rows = [
        [code(kind.__name__), code(above), of_docstring(kind.__doc__)] for kind, above in _below(errors.McNestedError)
    ]
    return table(["error", "a kind of", "when"], rows)


def _below(kind: type[Exception]) -> list[tuple[type[Exception], str]]:
    found = [(kind, kind.__mro__[1].__name__)]
    for each in kind.__subclasses__():
        if each.__module__ == errors.__name__:
            found += _below(each)
    return found


def _docs_below_fields(kind: type) -> dict[str, str]:
    """Return what is written below each field of a TypedDict, which Python itself doesn't keep."""
    source = ast.parse(inspect.getsource(kind)).body[0]
    return {
        field.target.id: inspect.cleandoc(str(below.value.value))
        for field, below in pairwise(getattr(source, "body", ()))
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant)
    }


def _name(action: Action) -> str:
    return f"{action.name[0]}+D" if action in PLACES else action.name


def _words(action: Action) -> str:
    return f"a cell {WAYS[STEP[action]]}" + (", then a block in front of the agent" if action in PLACES else "")


def _plain(kind: object) -> str:
    """Return a type as one reads it, without the modules' names."""
    text = kind if isinstance(kind, str) else kind.__name__ if isinstance(kind, type) else str(kind)
    return (
        text.rpartition(".")[2]
        if "[" not in text and "|" not in text
        else text.replace("mc_nested.arena.scenario.", "")
    )
