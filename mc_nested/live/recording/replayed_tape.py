"""A tape played back: each call must be the one that was recorded, and gets the answer that was recorded."""

from collections.abc import Iterator
from typing import Any

from mc_nested import errors
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.live.recording.plain_values import plain


class OtherCall(BaseException):
    """This version makes another call than was recorded. No ``except`` for errors ends it."""

    def __init__(self, then: list[Any] | None, now: list[Any]) -> None:
        super().__init__(then, now)
        self.then, self.now = then, now


class ReplayedTape:
    """The calls of a recording, one after the other.

    Args:
        calls: as plain values, in their order.
    """

    def __init__(self, calls: Iterator[list[Any]]) -> None:
        self._calls = calls
        self._next: list[Any] | None = None
        self.is_followed = False
        """Whether what is called now is compared: only within an episode, until it first differs."""
        self.stop_reason: str | None = None
        """Why a person stopped the run, once the calls have come that far."""
        self.count = 0

    def peek(self) -> list[Any] | None:
        """The next call of the thread that played; None at the end."""
        while self._next is None:
            call = next(self._calls, None)
            if call is None:
                return None
            self.count += 1
            if call[0] != "elsewhere":
                self._next = call
            elif call[1] == "stop":
                self.stop_reason = str(call[2])
        return self._next

    def skip(self) -> None:
        """Go on behind the next call."""
        self._next = None

    def same(self, *asked: Any) -> list[Any]:
        """The recorded call, which must begin as this one; what follows is its answer.

        Raises OtherCall if it is another one, or the error that the call then raised.
        """
        now = plain(list(asked))
        then = self.peek()
        if then is not None and then[0] == "error" and then[1] == asked[0]:
            self.skip()
            kind = getattr(errors, str(then[2]), errors.McNestedError)
            raise kind(then[3])
        if not self.is_followed or then is None or then[: len(now)] != now:
            self.is_followed = False
            raise OtherCall(then, now)
        self.skip()
        return then[len(now) :]

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """A note must be the same, too; outside an episode none is compared."""
        if self.is_followed:
            self.same("note", kind, facts)
