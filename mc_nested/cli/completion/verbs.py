"""All verbs with their options, as data: taken from the commands themselves, written to verbs.json, read from there.

scripts/write_completions.py writes the file; a test compares it with the commands.
"""

import json
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any, NamedTuple

FILE = "verbs.json"

ONES_OWN = {
    "run": "runs",
    "runs": "runs",
    "resume": "runs",
    "begin_from": "runs",
    "profile": "profiles",
    "profiles": "profiles",
}
"""The parameters, by name, whose values are one's own runs or profiles (values.py)."""


TYPERS_OWN = ("install_completion", "show_completion")
"""Parameters that Typer adds by itself."""


class Parameter(NamedTuple):
    """An option, or an argument, which has no names.

    Args:
        names: an option's, as ``--quiet`` and ``-q``.
        help: one line.
        words: how many words its value has; 0 for a flag.
        repeats: whether it may be given several times.
        ones_own: whether it is one of one's own ``runs`` or ``profiles``.
        choices: values that it can have. A file or a number has none.
    """

    names: Sequence[str] = ()
    help: str = ""
    words: int = 1
    repeats: bool = False
    ones_own: str = ""
    choices: Sequence[str] = ()


class Verb(NamedTuple):
    """A verb with its parameters, or with verbs of its own."""

    help: str
    parameters: Sequence[Parameter] = ()
    verbs: Mapping[str, "Verb"] = {}


def verb_of(command: Any, names: Mapping[str, Sequence[str]]) -> Verb:
    """What is to be completed of a command of Typer's; ``names`` has the choices of parameters by name."""
    return Verb(
        help=command.get_short_help_str(limit=80),
        parameters=[_parameter_of(each, names) for each in command.params if each.name not in TYPERS_OWN],
        verbs={verb: verb_of(inner, names) for verb, inner in getattr(command, "commands", {}).items()},
    )


def _parameter_of(parameter: Any, names: Mapping[str, Sequence[str]]) -> Parameter:
    is_option = parameter.param_type_name == "option"
    choices = [getattr(choice, "value", choice) for choice in parameter.type_descriptor.choices or ()]
    return Parameter(
        names=tuple(name for name in parameter.opts if is_option),
        help=parameter.help or "",
        words=0 if is_option and parameter.is_flag else parameter.nargs,
        repeats=is_option and parameter.multiple,
        ones_own=ONES_OWN.get(parameter.name, ""),
        choices=tuple(choices or names.get(parameter.name, ())),
    )


def text_of(verb: Verb) -> str:
    """A verb and all in it as JSON."""
    return json.dumps(_plain(verb), indent=1, ensure_ascii=False) + "\n"


def shipped() -> Verb:
    """The command with all its verbs, as they were when verbs.json was written."""
    text = (resources.files("mc_nested.cli.completion") / FILE).read_text("utf-8")
    return _verb(json.loads(text))


def _plain(verb: Verb) -> dict[str, Any]:
    """As JSON, without what is as by default."""
    parameters = [_said(each) for each in verb.parameters]
    verbs = {name: _plain(inner) for name, inner in verb.verbs.items()}
    return {"help": verb.help, "parameters": parameters, **({"verbs": verbs} if verbs else {})}


def _said(parameter: Parameter) -> dict[str, Any]:
    default = Parameter()._asdict()
    return {key: value for key, value in parameter._asdict().items() if value != default[key]}


def _verb(found: Mapping[str, Any]) -> Verb:
    parameters = [Parameter(**parameter) for parameter in found["parameters"]]
    verbs = {name: _verb(inner) for name, inner in found.get("verbs", {}).items()}
    return Verb(found["help"], parameters, verbs)
