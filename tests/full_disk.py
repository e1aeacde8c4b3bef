"""A disk that is full, in place of a function that writes to it."""

from typing import Any


def full_disk(*_: Any, **__: Any) -> Any:
    raise OSError(28, "No space left on device")
