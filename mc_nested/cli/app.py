"""The ``mc-nested`` command: its verbs; every mistake is one line and exit code 2."""

import contextlib
import importlib
import importlib.metadata
import os
import sys
from collections.abc import Sequence
from typing import Annotated, Any, cast

import typer
from typer.core import TyperCommand, TyperGroup

from mc_nested.cli.completion import COMPLETES, quick_app, typed_words
from mc_nested.cli.interrupt import INTERRUPTED, Stopped
from mc_nested.cli.output import epilog_of
from mc_nested.errors import McNestedError, UserError
from mc_nested.live.input.signals import EndedBySignal

NAME = "mc-nested"

VERBS = (
    "train",
    "reproduce",
    "study",
    "play",
    "build",
    "scenarios",
    "runs",
    "view",
    "calibrate",
    "profiles",
    "doctor",
    "try-it",
    "rehearse",
    "recordings",
    "replay",
)
"""Each is a module of this package; in the order of the help."""

HIDDEN = {"read": "doctor"}
"""Verbs that have a name of their own, too, outside the help: the verb that has them."""

MOVED = {
    "evaluate": "runs evaluate",
    "serve-game": "train serve",
    "cluster-keys": "train keys",
    "bug-report": "doctor bug-report",
    "sweep": "study sweep, or study ablation for sweep --ablation",
    "benchmark": "study benchmark",
    "cooperate": "train, with --builders",
}
"""What a verb of an earlier version is called now."""


def app_for(words: Sequence[str]) -> TyperCommand | TyperGroup:
    """Return the command with the verb that the words begin with, or with all verbs if they begin with none.

    A verb's module is loaded only if it is needed: together they take seconds and hundreds of megabytes. Raise
    UserError for a verb's former name.
    """
    if COMPLETES in os.environ:
        if quick := quick_app(VERBS):
            return cast("TyperCommand", typer.main.get_command(quick))
        words = typed_words()
    if words and words[0] in MOVED:
        raise UserError(f"{words[0]} is now {NAME} {MOVED[words[0]]}")
    app = typer.Typer(name=NAME, rich_markup_mode=None, pretty_exceptions_enable=False)
    app.callback(invoke_without_command=True)(version)
    named = words[:1] if words and words[0] in (*VERBS, *HIDDEN) else [*VERBS, *HIDDEN]
    for verb in named:
        name = verb.replace("-", "_")
        module = importlib.import_module(f"mc_nested.cli.{HIDDEN.get(verb, name)}")
        if verb not in HIDDEN and hasattr(module, "app"):  # verbs of its own
            app.add_typer(module.app, name=verb)
        else:
            app.command(verb, hidden=verb in HIDDEN)(getattr(module, name))
    command = cast("TyperGroup", typer.main.get_command(app))
    command.commands = {verb: command.commands[verb] for verb in named}  # Typer puts those with verbs of their own last
    _end_help_with_json_fields(command)
    return command


def _end_help_with_json_fields(command: Any) -> None:
    command.epilog = epilog_of(command.callback)
    for below in getattr(command, "commands", {}).values():
        _end_help_with_json_fields(below)


def version(show: Annotated[bool, typer.Option("--version", help="print the version")] = False) -> None:
    """Teach an agent to build in Minecraft Java Edition through the keyboard, the mouse and the screen."""
    if show:
        typer.echo(f"mc-nested {importlib.metadata.version('mc-nested')}")


MISTAKE = 2
"""Exit code of a mistake, or of a game that did not do what was asked."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit: 0, or 1 where what was looked at isn't right, or 2 with one line on standard error.

    130 after Ctrl+C.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words in ([], ["calibrate"], ["study"]):
        words.append("--help")
    try:
        code = app_for(words).main(args=words, prog_name=NAME, standalone_mode=False)
        if code == INTERRUPTED:  # typer's code for a KeyboardInterrupt, and for nothing else
            code = _say("stopped", INTERRUPTED)
    except typer.TyperException as error:
        code = _say(error.format_message())
    except McNestedError as error:
        code = _say(str(error))
    except OSError as error:  # a path that the system refuses
        code = _say(f"{error.filename or 'the system'}: {error.strerror or error}: name another path, or make room")
    except MemoryError:
        code = _say("not enough memory: fewer --trials, or a smaller network, batch or replay in the preset")
    except Stopped as stop:
        code = _say(str(stop), INTERRUPTED)
    except (KeyboardInterrupt, typer.Abort):
        code = _say("stopped", INTERRUPTED)
    except EndedBySignal as ending:
        code = _say("stopped", ending.status)
    sys.exit(code)


def _say(message: str, code: int = MISTAKE) -> int:
    with contextlib.suppress(OSError):  # a pipe that nobody reads any more
        print("mc-nested: " + " ".join(message.split()), file=sys.stderr)
    return code
