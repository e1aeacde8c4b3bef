"""The compiler of everything that is compiled here: Numba's, with a cache that notices a change in any source file.

Numba keeps compiled functions on disk and looks at the file of each function, to see whether it has changed. Functions
of other files, and their constants, are compiled into it, too: with Numba's own cache, an update of one file would go
on computing what it computed before.
"""

import hashlib
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from numba import njit
from numba.core.caching import CompileResultCacheImpl, FunctionCache

PACKAGE = Path(__file__).parents[2]

SOURCES = (PACKAGE / "arena", PACKAGE / "learn")
"""The folders of all that can be compiled into a function: learning, and the task, whose constants it may use."""

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(*, fastmath: bool = False, nogil: bool = False) -> Callable[[Function], Function]:
    """Compile the function when it is first called, and keep that on disk until a source file changes.

    Args:
        fastmath: whether the order of sums and products may be changed.
        nogil: whether other threads go on while it runs.
    """

    def compile_it(function: Function) -> Function:
        dispatcher: Any = njit(fastmath=fastmath, nogil=nogil, error_model="numpy")(function)
        if hasattr(dispatcher, "enable_caching"):  # otherwise Numba is told to leave everything to Python
            dispatcher._cache = _Cache(function)  # type: ignore[no-untyped-call]  # Numba's
        made: Function = dispatcher
        return made

    return compile_it


@cache
def fingerprint_of(folders: Iterable[Path]) -> str:
    """A hash of every Python file in the folders, of its name and text."""
    digest = hashlib.sha256()
    for folder in folders:
        for path in sorted(folder.rglob("*.py")):
            digest.update(f"{path.relative_to(folder).as_posix()}\0".encode())
            digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


class _Locator:
    """Where Numba's own locator keeps a function, as long as no source file has changed."""

    def __init__(self, numbas_own: Any) -> None:
        self._numbas_own = numbas_own

    def __getattr__(self, name: str) -> Any:
        return getattr(self._numbas_own, name)

    def get_source_stamp(self) -> tuple[Any, str]:
        return self._numbas_own.get_source_stamp(), fingerprint_of(SOURCES)


class _CacheFiles(CompileResultCacheImpl):
    @property
    def locator(self) -> _Locator:
        return _Locator(super().locator)


class _Cache(FunctionCache):
    _impl_class = _CacheFiles
