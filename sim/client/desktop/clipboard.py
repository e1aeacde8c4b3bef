"""The virtual clipboard."""


class VirtualClipboard:
    """A text, empty at first."""

    def __init__(self) -> None:
        self._text = ""

    def read(self) -> str:
        return self._text

    def write(self, text: str) -> None:
        self._text = text
