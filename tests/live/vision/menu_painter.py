"""Menus painted for the tests from FACTS: Screens and their buttons, with buttons as the game has drawn them."""

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font

Colour = tuple[int, int, int]

WHITE, OLD_WHITE, HOVERED, GREY = (255, 255, 255), (224, 224, 224), (255, 255, 160), (160, 160, 160)


class MenuPainter:
    """Paints into a frame in GUI pixels; ``rng`` gives the grain of the buttons' faces."""

    def __init__(self, frame: Frame, scale: int, font: Font, rng: np.random.Generator) -> None:
        self.frame = frame
        self.scale = scale
        self.width, self.height = -(-frame.shape[1] // scale), -(-frame.shape[0] // scale)
        self._font = font
        self._rng = rng

    def button(self, label: str, left: int, top: int, width: int, colour: Colour = WHITE) -> tuple[float, float]:
        """Draw a button with its label; its middle in pixels of the frame."""
        outline = 255 if colour == HOVERED else 0
        self._fill(left, top, np.full((20, width, 3), outline, np.uint8))
        face = 44 if colour == GREY else 111
        self._fill(left + 1, top + 1, self._rng.integers(face - 8, face + 12, (18, width - 2, 3), np.uint8))
        self._fill(left + 1, top + 1, np.full((1, width - 2, 3), face + 58, np.uint8))
        self.text(label, left + (width - len(self._font.columns(label))) // 2, top + 6, colour)
        return (left + width / 2) * self.scale, (top + 10) * self.scale

    def text(self, text: str, left: int, top: int, colour: Colour = WHITE) -> None:
        """Draw a shadowed text."""
        columns = np.frombuffer(self._font.columns(text), np.uint8)
        ink = np.unpackbits(columns[np.newaxis], axis=0, bitorder="little").astype(bool)
        shadow = tuple((channel & 0xFC) >> 2 for channel in colour)
        for down, drawn in ((1, shadow), (0, colour)):
            part = self._part(left + down, top + down, ink.shape[1], 8)
            mask = ink.repeat(self.scale, 0).repeat(self.scale, 1)[: part.shape[0], : part.shape[1]]
            part[mask] = drawn[::-1]

    def _fill(self, left: int, top: int, dots: Frame) -> None:
        part = self._part(left, top, dots.shape[1], dots.shape[0])
        part[:] = dots.repeat(self.scale, 0).repeat(self.scale, 1)[: part.shape[0], : part.shape[1]]

    def _part(self, left: int, top: int, width: int, height: int) -> Frame:
        scale = self.scale
        return self.frame[top * scale : (top + height) * scale, left * scale : (left + width) * scale]
