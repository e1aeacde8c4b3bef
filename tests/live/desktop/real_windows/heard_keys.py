"""A made-up key listener; the test says what it hears."""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.desktop.key_listener import IsListening, OnKey


class HeardKeys:
    """Listens for as long as its context lasts, unless ``is_silent``: then the desktop lets no program listen."""

    def __init__(self, *, is_silent: bool = False) -> None:
        self.is_listening = False
        self._is_silent = is_silent
        self._on_key: OnKey = lambda *_: None

    @contextmanager
    def listening(self, on_key: OnKey) -> Iterator[IsListening]:
        self._on_key, self.is_listening = on_key, not self._is_silent
        yield lambda: self.is_listening
        self.is_listening = False

    def press(self, name: str) -> None:
        self._on_key(name, True)

    def release(self, name: str) -> None:
        self._on_key(name, False)
