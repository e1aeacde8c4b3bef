"""Compile functions with Numba, and keep them on disk in a cache that notices a change in any file they need.

Numba keeps compiled functions on disk and looks at the file of each function, to see whether it has changed. Functions
of other files, and their constants, are compiled into it, too: with Numba's own cache, an update of one file would go
on computing what it computed before. So here all files count that a function's file imports, directly or not.
"""

import ast
import hashlib
import inspect
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from numba import config, njit
from numba.core.caching import CompileResultCacheImpl, FunctionCache

ROOT = Path(__file__).parents[1]
"""The folder that holds the package; of an installed one, all other packages too."""

PACKAGE = __name__.partition(".")[0]

IN_PYTHON = bool(config.DISABLE_JIT)  # type: ignore[attr-defined]  # Numba makes it from the environment
"""Whether Numba is told to leave everything to Python: for debuggers, and for tests of indices."""

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(*, fused: bool = False, nogil: bool = False) -> Callable[[Function], Function]:
    """Compile the function when it is first called, and keep that on disk until a file that it needs changes.

    Args:
        fused: whether a product and a sum may become one instruction, which rounds once.
        nogil: whether other threads go on while it runs.
    """

    def compile_it(function: Function) -> Function:
        dispatcher: Any = njit(fastmath={"contract"} if fused else False, nogil=nogil, error_model="numpy")(function)
        if hasattr(dispatcher, "enable_caching"):  # otherwise Numba is told to leave everything to Python
            dispatcher._cache = _Cache(function)  # type: ignore[no-untyped-call]  # Numba's
        made: Function = dispatcher
        return made

    return compile_it


@cache
def fingerprint_of(source: Path, root: Path = ROOT, package: str = PACKAGE) -> str:
    """Return a hash of the file and of every file of the package below ``root`` that it imports, directly or not."""
    found, new = {source}, [source]
    while new:
        imported = _imported_by(new.pop(), root, package)
        new += sorted(imported - found)
        found |= imported
    digest = hashlib.sha256()
    for path in sorted(found):
        digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


def _imported_by(source: Path, root: Path, package: str) -> set[Path]:
    """Return the files of the package below ``root`` that the file imports by their full names."""
    modules: set[str] = set()
    for node in ast.walk(ast.parse(source.read_bytes())):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            modules |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    bases = [root.joinpath(*module.split(".")) for module in modules if module.partition(".")[0] == package]
    return {path for base in bases for path in (base.with_suffix(".py"), base / "__init__.py") if path.is_file()}


class _Locator:
    """A locator that keeps a function where Numba's own does, as long as no file that it needs has changed."""

    def __init__(self, numbas_own: Any, source: Path) -> None:
        self._numbas_own = numbas_own
        self._source = source

    def __getattr__(self, name: str) -> Any:
        return getattr(self._numbas_own, name)

    def get_source_stamp(self) -> tuple[Any, str]:
        return self._numbas_own.get_source_stamp(), fingerprint_of(self._source)


class _CacheFiles(CompileResultCacheImpl):
    def __init__(self, function: Callable[..., Any]) -> None:
        self._source = Path(inspect.getfile(function))
        super().__init__(function)  # type: ignore[no-untyped-call]  # Numba's

    @property
    def locator(self) -> _Locator:
        return _Locator(super().locator, self._source)


class _Cache(FunctionCache):
    _impl_class = _CacheFiles

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Load what was compiled for that signature, if it is there.

        Forget all of it where a class that it needs is gone.
        """
        try:
            return super().load_overload(signature, target_context)  # type: ignore[no-untyped-call]  # Numba's
        except (ModuleNotFoundError, AttributeError):  # its file was renamed since
            self.flush()  # type: ignore[no-untyped-call]  # Numba's
            return None
