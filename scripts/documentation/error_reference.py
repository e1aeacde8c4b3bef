"""The reference of what can go wrong, made from the code: exit codes, and the tree of errors."""

import inspect

from mc_nested import errors
from mc_nested.cli import app, doctor, interrupt, recordings, replay
from mc_nested.live.input import signals
from scripts.documentation.attribute_docs import attribute_docs
from scripts.documentation.markdown_text import code, of_docstring, sentence, table

CODES = (
    ("0", "It is done."),
    (str(doctor.FAILED), "`mc-nested doctor`: " + attribute_docs(doctor)["FAILED"]),
    (str(replay.DIFFERENT), "`mc-nested replay`: " + attribute_docs(replay)["DIFFERENT"]),
    (str(recordings.DAMAGED), "`mc-nested recordings`: " + attribute_docs(recordings)["DAMAGED"]),
    (str(app.MISTAKE), attribute_docs(app)["MISTAKE"]),
    (str(interrupt.INTERRUPTED), attribute_docs(interrupt)["INTERRUPTED"]),
    ("128 + n", inspect.getdoc(signals.EndedBySignal) or ""),
)
"""What the command ends with, and the constant's own words."""


def exit_codes() -> str:
    """The table of exit codes."""
    return table(["code", "what it means"], [[each, sentence(of_docstring(text))] for each, text in CODES])


def error_tree() -> str:
    """Every error that is raised on purpose, below the one that it is a kind of."""
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
