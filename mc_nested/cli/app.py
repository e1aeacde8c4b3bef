"""The ``mc-nested`` command: its verbs; every mistake is one line and exit code 2."""

import contextlib
import importlib
import importlib.metadata
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from mc_nested.cli.interrupt import INTERRUPTED, Stopped
from mc_nested.errors import McNestedError
from mc_nested.live.input.signals import EndedBySignal

VERBS = (
    "train",
    "reproduce",
    "sweep",
    "benchmark",
    "evaluate",
    "play",
    "scenarios",
    "read",
    "calibrate",
    "doctor",
    "rehearse",
)
"""Each is a module of this package; in the order of the help."""


def app_for(words: Sequence[str]) -> typer.Typer:
    """The command with the verb that the words begin with, or with all verbs if they begin with none.

    A verb's module is loaded only if it is needed: together they take seconds and hundreds of megabytes.
    """
    app = typer.Typer(name="mc-nested", add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)
    app.callback(invoke_without_command=True)(version)
    for verb in words[:1] if words and words[0] in VERBS else VERBS:
        module = importlib.import_module(f"mc_nested.cli.{verb}")
        if verb == "calibrate":
            app.add_typer(module.app, name=verb)
        else:
            app.command()(getattr(module, verb))
    return app


def version(show: Annotated[bool, typer.Option("--version", help="print the version")] = False) -> None:
    """Teach an agent to build in Minecraft Java Edition through the keyboard, the mouse and the screen."""
    if show:
        typer.echo(f"mc-nested {importlib.metadata.version('mc-nested')}")


MISTAKE = 2
"""Exit code of a mistake, or of a game that did not do what was asked."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit: 0, or 2 with one line on standard error, or 130 after Ctrl+C."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words in ([], ["calibrate"]):
        words.append("--help")
    try:
        code = app_for(words)(args=words, standalone_mode=False)
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
