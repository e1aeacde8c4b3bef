"""The reference of exit codes and errors, as the code has them."""

import inspect

from mc_nested import errors
from scripts.documentation.error_reference import error_tree, exit_codes


def test_every_exit_code_has_its_meaning() -> None:
    page = exit_codes()
    assert "| 2 | Exit code of a mistake, or of a game that did not do what was asked. |" in page
    assert "| 130 | Exit code after Ctrl+C. |" in page
    assert "| 1 | `mc-nested recordings`: The exit code of verify where something of it is lost. |" in page
    assert page.count("\n| ") == 8


def test_every_error_is_below_the_one_that_it_is_a_kind_of() -> None:
    tree = error_tree()
    for name, kind in inspect.getmembers(errors, inspect.isclass):
        assert f"| `{name}` | `{kind.__mro__[1].__name__}` | " in tree
    assert tree.index("`ProfileError`") < tree.index("`DesktopError`") < tree.index("`NoWindowError`")
