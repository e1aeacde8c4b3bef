"""The ``mc-nested`` command: its verbs; every mistake is one line and exit code 2."""

import contextlib
import importlib
import importlib.metadata
import os
import sys
from collections.abc import Collection, Sequence
from typing import Annotated, Any, cast

import typer
from typer.core import TyperCommand, TyperGroup

from mc_nested.cli.completion import COMPLETES, quick_app, typed_words
from mc_nested.cli.interrupt import INTERRUPTED, Stopped
from mc_nested.cli.output import epilog_of
from mc_nested.errors import McNestedError
from mc_nested.live.input.signals import EndedBySignal

NAME = "mc-nested"

VERBS = {
    "demo": "Train the nested agent on the line until it builds all of it, and show that: the first thing to try.",
    "train": "Train an agent; Ctrl+C saves, and --resume goes on from there.",
    "reproduce": "Repeat the paper's experiment and test its claims.",
    "study": "Train and report on one of several studies; Ctrl+C saves, and --resume goes on from there.",
    "play": "Play one greedy episode and show the arena as it is built; after a mishap the episode starts over.",
    "build": "Build a design without learning, and show the arena as it is built; after a mishap it starts over.",
    "scenarios": "List the designs with a drawing, the optimum and the fewest steps; of a schematic its layers, too.",
    "runs": "List your runs, look at one, evaluate it, rename it, delete it; alone it lists those in runs/.",
    "view": "Watch a training on this computer as it goes on, or one that has ended, moment by moment.",
    "calibrate": "Tell the agent where your arena and your buttons are.",
    "profiles": "List your profiles, look at one, rename it, delete it; alone it lists them.",
    "doctor": "Look at this computer, the game's window and its options: each row with the one thing to do.",
    "try-it": "Try everything in your game in a few minutes, and make one file of what happened, to send to those who "
    "ask.",
    "rehearse": "Open a window that looks and acts like the game, to calibrate and train in without Minecraft; "
    "close it to end.",
    "recordings": "List the recordings that are kept; verify, trim and cut them.",
    "replay": "Read and decide again what a recording holds: exit code 0 if all is as it was, 1 if anything differs.",
}
"""Each is a module of this package, with the line that its help begins with; in the order of the help."""

HIDDEN = {"read": "doctor"}
"""Verbs that have a name of their own, too, outside the help: the verb that has them."""


def app_for(words: Sequence[str]) -> TyperCommand | TyperGroup:
    """Return the command for these words, or for the words that a shell asks to complete."""
    if COMPLETES in os.environ:
        if quick := quick_app(VERBS):
            return cast("TyperCommand", typer.main.get_command(quick))
        words = typed_words()
    return app_with([word for word in words if not word.startswith("-")][:1])


def app_with(loaded: Collection[str]) -> TyperGroup:
    """Return the command with all verbs. Those that aren't ``loaded`` can only be listed.

    A verb's module is loaded only if it is needed: together they take seconds and hundreds of megabytes.
    """
    app = typer.Typer(name=NAME, rich_markup_mode=None, pretty_exceptions_enable=False)
    app.callback(invoke_without_command=True)(version)
    for verb in (*VERBS, *HIDDEN):
        if verb not in loaded:
            app.command(verb, help=VERBS.get(verb), hidden=verb in HIDDEN)(lambda: None)
            continue
        name = verb.replace("-", "_")
        module = importlib.import_module(f"mc_nested.cli.{HIDDEN.get(verb, name)}")
        if verb not in HIDDEN and hasattr(module, "app"):  # verbs of its own
            app.add_typer(module.app, name=verb)
        else:
            app.command(verb, hidden=verb in HIDDEN)(getattr(module, name))
    command = cast("TyperGroup", typer.main.get_command(app))
    command.commands = {verb: command.commands[verb] for verb in (*VERBS, *HIDDEN)}  # Typer puts groups last
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
        code = _say(error.format_message().replace("Value error, ", ""))
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
