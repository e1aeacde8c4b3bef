"""The command as a shell completes it: all verbs and options of verbs.json, and no work behind them."""

import inspect
from collections.abc import Callable
from typing import Annotated, Any

import typer

from mc_nested.cli.completion import values
from mc_nested.cli.completion.verbs import Parameter, Verb

ONES_OWN: dict[str, values.Values] = {"runs": values.runs, "profiles": values.profiles}


def completing_app(command: Verb) -> typer.Typer:
    """A Typer that completes what the command takes, with --install-completion and --show-completion."""
    return _group(command)


def _group(verb: Verb) -> typer.Typer:
    app = typer.Typer(name="mc-nested", rich_markup_mode=None, pretty_exceptions_enable=False)
    app.callback(invoke_without_command=True)(_function(verb))
    for name, inner in verb.verbs.items():
        if inner.verbs:
            app.add_typer(_group(inner), name=name)
        else:
            app.command(name)(_function(inner))
    return app


def _function(verb: Verb) -> Callable[..., None]:
    """A function that takes a verb's parameters and does nothing."""

    def does_nothing(**_: Any) -> None: ...

    does_nothing.__doc__ = verb.help
    parameters = [_parameter(f"p{number}", each) for number, each in enumerate(verb.parameters)]
    does_nothing.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]  # Typer reads it
    return does_nothing


def _parameter(name: str, parameter: Parameter) -> inspect.Parameter:
    completes = ONES_OWN.get(parameter.ones_own) or values.of(parameter.choices)

    def complete(incomplete: str) -> list[str]:
        return completes(incomplete)

    kind: Any = bool if parameter.names and not parameter.words else str
    if parameter.words > 1:
        kind = tuple[(str,) * parameter.words]  # type: ignore[misc]  # as many as the option takes
    if parameter.repeats or parameter.words < 0:
        kind = list[kind]
    shown = parameter.help.replace("[", r"\[")  # Typer takes help for Rich's markup here
    if parameter.names:
        info = typer.Option(*parameter.names, help=shown, autocompletion=complete)
    else:
        info = typer.Argument(help=shown, autocompletion=complete)
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[kind | None, info]
    )
