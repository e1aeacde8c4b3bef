"""The docstrings that stand below assignments, which Python itself doesn't keep."""

import ast
import inspect
import textwrap
from itertools import pairwise
from types import ModuleType


def attribute_docs(source: ModuleType | type) -> dict[str, str]:
    """What is written below each name's assignment in a module or a class."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(source)))
    body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) and isinstance(source, type) else tree.body
    found: dict[str, str] = {}
    for statement, after in pairwise(body):
        text = _string(after)
        if text is not None:
            found.update(dict.fromkeys(_names(statement), inspect.cleandoc(text)))
    return found


def _names(statement: ast.stmt) -> list[str]:
    if isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name):
        return [statement.target.id]
    if isinstance(statement, ast.Assign):
        return [target.id for target in statement.targets if isinstance(target, ast.Name)]
    return []


def _string(statement: ast.stmt) -> str | None:
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
        return statement.value.value if isinstance(statement.value.value, str) else None
    return None
