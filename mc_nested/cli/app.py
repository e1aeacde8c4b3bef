"""The ``mc-nested`` command: its verbs; every mistake is one line and exit code 2."""

import contextlib
import importlib
import importlib.metadata
import os
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from mc_nested.cli.interrupt import INTERRUPTED, Stopped
from mc_nested.cli.json_fields import epilog_of
from mc_nested.errors import McNestedError, UserError
from mc_nested.live.input.signals import EndedBySignal

NAME = "mc-nested"

COMPLETES = "_MC_NESTED_COMPLETE"
"""The environment variable by which a shell asks for completions, as Typer names it."""

COMPLETION_OPTIONS = ("--install-completion", "--show-completion")

VERBS = (
    "train",
    "cooperate",
    "reproduce",
    "study",
    "evaluate",
    "play",
    "build",
    "scenarios",
    "read",
    "runs",
    "view",
    "calibrate",
    "profiles",
    "doctor",
    "serve-game",
    "rehearse",
    "recordings",
    "replay",
    "bug-report",
    "cluster-keys",
)
"""Each is a module of this package; in the order of the help."""


MOVED = {
    "sweep": "study sweep, or study ablation for sweep --ablation",
    "benchmark": "study benchmark",
}
"""Verbs that have another name now."""


def app_for(words: Sequence[str]) -> typer.Typer:
    """The command with the verb that the words begin with, or with all verbs if they begin with none.

    A verb's module is loaded only if it is needed: together they take seconds and hundreds of megabytes. To complete a
    command line none is.
    """
    if words and words[0] in MOVED:
        raise UserError(f"{words[0]} is now mc-nested {MOVED[words[0]]}")
    if COMPLETES in os.environ or (words and words[0] in COMPLETION_OPTIONS):
        return _completing_app()
    app = typer.Typer(name=NAME, rich_markup_mode=None, pretty_exceptions_enable=False)
    app.callback(invoke_without_command=True)(version)
    for verb in words[:1] if words and words[0] in VERBS else VERBS:
        name = verb.replace("-", "_")
        module = importlib.import_module(f"mc_nested.cli.{name}")
        if hasattr(module, "app"):  # verbs of its own
            app.add_typer(module.app, name=verb)
        else:
            app.command(verb, epilog=epilog_of(verb))(getattr(module, name))
    return app


def _completing_app() -> typer.Typer:
    from mc_nested.cli.completion.app import completing_app
    from mc_nested.cli.completion.shell import check_shell
    from mc_nested.cli.completion.verbs import shipped

    if COMPLETES not in os.environ:
        check_shell()
    return completing_app(shipped())


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
    if words in ([], ["calibrate"]):
        words.append("--help")
    try:
        code = app_for(words)(args=words, prog_name=NAME, standalone_mode=False)
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
