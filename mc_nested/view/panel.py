"""Panel: a part of the view that is drawn by a function, and only where something in it has changed."""

from collections.abc import Callable

from rich.text import Text
from textual.events import Resize
from textual.widget import Widget

from mc_nested.view.words import StatusShown

Draw = Callable[[StatusShown, int, int], Text]
"""Draws what is shown in so many columns and lines."""


class Panel(Widget):
    """Shows what ``draw`` makes of the status, as large as it is."""

    def __init__(self, draw: Draw, *, id: str) -> None:  # noqa: A002 - Textual's name
        super().__init__(id=id)
        self._draw = draw
        self._shown: StatusShown | None = None
        self._text = Text()

    def show(self, shown: StatusShown) -> None:
        """Show a status, if it differs from what is there."""
        self._shown = shown
        text = self._draw(shown, self.size.width, self.size.height)
        if text != self._text or text.spans != self._text.spans:
            self._text = text
            self.refresh()

    def on_resize(self, _: Resize) -> None:
        """Draw it again, for its new size."""
        if self._shown is not None:
            self.show(self._shown)

    def render(self) -> Text:
        """The text."""
        return self._text
