"""The two scales of the game's texts, in framebuffer pixels to a GUI pixel (FACTS: The F3 debug screen)."""

from typing import NamedTuple


class Scales(NamedTuple):
    """``gui`` is that of menus, chat and hotbar, ``debug`` that of the debug screen's text, the same or smaller.

    Up to 26.2 they are always the same.
    """

    gui: int
    debug: int

    def __str__(self) -> str:
        return f"{self.gui}" if self.gui == self.debug else f"{self.gui}, debug screen {self.debug}"


def largest_gui_scale(size: tuple[int, int]) -> int:
    """The largest GUI scale that a window (width, height) in framebuffer pixels can hold."""
    return max(1, min(size[0] // 320, size[1] // 240))
