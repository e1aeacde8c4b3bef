"""The reference of the command line, made from the command itself: every verb, argument and option."""

from collections.abc import Iterator, Mapping
from enum import Enum
from pathlib import Path
from typing import Any, get_args

from typer.core import TyperArgument, TyperCommand, TyperGroup, TyperOption

from mc_nested.cli.app import VERBS, app_for
from mc_nested.cli.output import json_fields
from scripts.documentation.markdown_text import code, number, sentence, table

VALUES: dict[Any, str] = {int: "NUMBER", float: "NUMBER", str: "TEXT", Path: "FILE"}
"""What stands for a value that its option doesn't name."""


def markdown() -> str:
    """A section for each verb, in the order of the help."""
    return "\n".join(_section(words, command) for words, command in verbs())


def verbs() -> Iterator[tuple[str, TyperCommand | TyperGroup]]:
    """Each verb's words and its command, the bare command first; ``calibrate all`` and its like are verbs, too."""
    return _below("mc-nested", app_for(()))


def options_of(command: TyperCommand | TyperGroup) -> list[TyperOption]:
    """The options that a person may give; --help is left out, which every verb has."""
    return [
        each
        for each in command.params
        if isinstance(each, TyperOption) and not each.hidden and "--help" not in each.opts
    ]


def _below(words: str, command: Any) -> Iterator[tuple[str, TyperCommand | TyperGroup]]:
    yield words, command
    if isinstance(command, TyperGroup):
        for name in sorted(command.commands, key=lambda name: VERBS.index(name) if name in VERBS else len(VERBS)):
            if not command.commands[name].hidden:
                yield from _below(f"{words} {name}", command.commands[name])


def _section(words: str, command: TyperCommand | TyperGroup) -> str:
    arguments = [_argument_name(each) for each in command.params if isinstance(each, TyperArgument)]
    below = ["VERB"] if isinstance(command, TyperGroup) else []
    usage = [words, *arguments, *(["[OPTIONS]"] if options_of(command) else []), *below]
    parts = [f"## {words}", sentence(" ".join((command.help or "").split())), f"```text\n{' '.join(usage)}\n```"]
    return "\n\n".join([*parts, *_tables(command), *_json_fields(command)]) + "\n"


def _tables(command: TyperCommand | TyperGroup) -> list[str]:
    arguments = [each for each in command.params if isinstance(each, TyperArgument)]
    rows = [[code(_argument_name(each)), _meaning(each)] for each in arguments]
    rows += [[code(_option_name(each)), _meaning(each)] for each in options_of(command)]
    return [table(["name", "what it is"], rows)] if rows else []


def _json_fields(command: TyperCommand | TyperGroup) -> list[str]:
    """What the verb prints with --json, if it does."""
    fields = json_fields(command.callback)
    if not fields:
        return []
    return ["With `--json` it prints an object:", table(["field", "what it is"], _rows(fields))]


def _rows(fields: Mapping[str, str]) -> list[list[str]]:
    return [[code(name), sentence(meaning)] for name, meaning in fields.items()]


def _argument_name(argument: TyperArgument) -> str:
    return argument.metavar or (argument.name or "").upper()


def _option_name(option: TyperOption) -> str:
    names = ", ".join([*option.opts, *option.secondary_opts])
    return names if option.is_flag else f"{names} {_value(option)}"


def _value(option: TyperOption) -> str:
    if option.metavar:
        return option.metavar
    kind = option.type_descriptor.annotation
    kinds = [each for each in (*get_args(kind), kind) if isinstance(each, type)]
    if issubclass(kinds[0], Enum):
        return "|".join(str(each.value) for each in kinds[0])
    return VALUES[kinds[0]]


def _meaning(parameter: TyperArgument | TyperOption) -> str:
    default = parameter.default
    has_default = isinstance(default, str | int | float) and not isinstance(default, bool) and parameter.show_default
    shown = default.value if isinstance(default, Enum) else default
    if isinstance(parameter.show_default, str):
        has_default, shown = True, parameter.show_default
    text = sentence((parameter.help or "") + (f" [{shown}]" if has_default else ""))
    low, high = parameter.min, parameter.max
    if low is None:
        return text
    return f"{text} {number(low)} or more." if high is None else f"{text} From {number(low)} to {number(high)}."
