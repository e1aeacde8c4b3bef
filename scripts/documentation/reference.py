"""The reference of the command line and of errors, made from the code."""

from typing import Any

import typer
from typer.cli import get_docs_for_click

from mc_nested import errors
from mc_nested.cli.app import HIDDEN, VERBS, app_with
from scripts.documentation.markdown_text import code, of_docstring, table


def command_line() -> str:
    """Describe every verb, argument and option, as Typer does it."""
    command = app_with({**VERBS, **HIDDEN})
    _tell_whole_summaries(command)
    return get_docs_for_click(obj=command, ctx=typer.Context(command), name="mc-nested", indent=1)


def _tell_whole_summaries(command: Any) -> None:
    """Let lists of verbs give the whole first paragraph of each one's help, which is cut otherwise."""
    for below in getattr(command, "commands", {}).values():
        below.short_help = " ".join((below.help or "").partition("\n\n")[0].split())
        _tell_whole_summaries(below)


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
