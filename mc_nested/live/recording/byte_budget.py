"""How many bytes of pictures a recording may write: so many a second on average, and some at once."""

BYTES_A_SECOND = 60_000
"""3.6 MB a minute."""

AT_ONCE = 3_000_000
"""About one picture of a large window that can't be packed well."""


class ByteBudget:
    """What may be spent now. A picture's size is known only once it is packed: the last one may overdraw it.

    Args:
        now: seconds from an arbitrary zero.
    """

    def __init__(self, now: float) -> None:
        self._left: float = AT_ONCE
        self._at = now

    def may_spend(self, now: float) -> bool:
        """Whether anything is left at that time."""
        self._left = min(AT_ONCE, self._left + (now - self._at) * BYTES_A_SECOND)
        self._at = now
        return self._left > 0

    def spend(self, count: int) -> None:
        """Take so many bytes off."""
        self._left -= count
