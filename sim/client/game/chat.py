"""The chat: messages that appear and fade, and the line being typed (FACTS: Answers; The chat's line)."""

from collections import deque
from dataclasses import dataclass
from itertools import islice
from typing import NamedTuple

from sim.client.game.options import HALF
from sim.client.game.widgets import RED, WHITE, Colour

LONGEST = 256
"""Characters that a typed line may have."""
_LASTS = 200
"""Ticks that a message stays; in the last tenth of them it fades."""
_STEPS = 8
_KEPT, _SHOWN = 100, 10


@dataclass(frozen=True)
class Message:
    """A message, and the tick in which it came."""

    text: str
    colour: Colour
    born: int


class ChatLine(NamedTuple):
    """A message as it is seen; ``opacity`` is out of 8, ``ground`` the alpha of the black behind it, out of 255."""

    text: str
    colour: Colour
    opacity: int
    ground: int = HALF


class TypedLine(NamedTuple):
    """The line being typed, as it is seen: a draft is grey and slanted; ``ground`` is as a message's."""

    text: str
    is_draft: bool = False
    ground: int = HALF


class VirtualChat:
    """The messages, and the line being typed; ``typed`` is None while the chat is closed.

    ``draft`` is what was typed before and not sent, and ``is_draft`` whether the open line is still that.
    """

    def __init__(self, draft: str = "") -> None:
        self._messages: deque[Message] = deque(maxlen=_KEPT)
        self.typed: str | None = None
        self.is_selected = False
        self.draft, self.is_draft = draft, False

    def open(self, prefix: str = "") -> None:
        """Begin a line: with the draft, where a key that begins with ``prefix`` may bring it back, else the prefix."""
        self.is_draft, self.is_selected = bool(self.draft) and self.draft.startswith(prefix), False
        self.typed = self.draft if self.is_draft else prefix

    def close(self, *, keeps_draft: bool) -> None:
        """Close the line, if it is open, and keep it as the draft or forget that."""
        if self.typed is not None:
            self.draft = self.typed if keeps_draft and self.typed.strip() else ""
        self.typed, self.is_draft, self.is_selected = None, False, False

    def say(self, text: str, tick: int, *, is_error: bool = False) -> None:
        """Add a message."""
        self._messages.appendleft(Message(text, RED if is_error else WHITE, tick))

    def clear(self) -> None:
        """Forget every message, as F3+D does."""
        self._messages.clear()

    def insert(self, text: str) -> None:
        """Type or paste into the open chat; text beyond LONGEST and unprintable characters are dropped."""
        before = "" if self.is_selected else self.typed or ""
        self.typed = (before + "".join(char for char in text if char.isprintable()))[:LONGEST]
        self.is_selected = self.is_draft = False

    def backspace(self) -> None:
        """Delete the last letter, or what is selected, or the whole of a draft."""
        self.typed = "" if self.is_selected or self.is_draft else (self.typed or "")[:-1]
        self.is_selected = self.is_draft = False

    def lines(self, tick: int, ground: int = HALF) -> tuple[ChatLine, ...]:
        """Return the lines that show now, the newest first, on that ground; with the chat open, older messages too."""
        if self.typed is not None:
            newest = islice(self._messages, 2 * _SHOWN)
            return tuple(ChatLine(message.text, message.colour, _STEPS, ground) for message in newest)
        seen: list[ChatLine] = []
        for message in self._messages:
            opacity = _opacity(tick - message.born)
            if not opacity or len(seen) == _SHOWN:
                break
            seen.append(ChatLine(message.text, message.colour, opacity, ground))
        return tuple(seen)


def _opacity(age: int) -> int:
    if age <= _LASTS * 9 // 10:
        return _STEPS
    return round(_STEPS * min(1.0, max(0.0, 10 * (1 - age / _LASTS))) ** 2)
