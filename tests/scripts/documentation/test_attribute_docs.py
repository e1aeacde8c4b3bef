"""The docstrings below assignments."""

from typing import TypedDict

import pytest

from mc_nested.cli import interrupt
from scripts.documentation.attribute_docs import attribute_docs


class Info(TypedDict):
    """What is known."""

    cell: int
    """Where it is."""

    steps: int
    score: float
    """On two
    lines."""


def test_each_name_of_a_class_has_the_string_below_it() -> None:
    assert attribute_docs(Info) == {"cell": "Where it is.", "score": "On two\nlines."}


def test_each_name_of_a_module_has_the_string_below_it() -> None:
    assert attribute_docs(interrupt)["INTERRUPTED"] == "Exit code after Ctrl+C."


def test_a_name_without_one_is_not_there() -> None:
    with pytest.raises(KeyError):
        attribute_docs(Info)["steps"]
