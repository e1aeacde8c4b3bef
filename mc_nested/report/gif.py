"""A .gif film, by Pillow: it needs nothing else, and everything shows it."""

import zlib
from pathlib import Path

import numpy as np
from PIL import Image

from mc_nested.arena.drawing import Picture
from mc_nested.report.arena_picture import DRAWN, INK, PALE_INK, PAPER

CHOSEN = 64
"""Colours beside those that are drawn: the window's. All pictures share them, so that only what changed is written."""

SAMPLE = 4_000_000
"""Pixels at most from which they are chosen."""

EDGES = tuple(
    tuple(round(ink + (paper - ink) * share) for ink, paper in zip(colour, PAPER, strict=True))
    for colour, share in ((INK, 0.25), (INK, 0.5), (INK, 0.75), (PALE_INK, 0.33), (PALE_INK, 0.66))
)
"""Colours of the letters."""


class GifEncoder:
    """Keeps the pictures, and writes them at the end. The film repeats for ever.

    Args:
        path: the file.
        fps: pictures a second.
    """

    def __init__(self, path: Path, fps: int) -> None:
        self._path, self._picture_ms = path, 1000 // fps
        self._pictures: list[_Packed] = []
        self._shown_ms: list[int] = []
        self._last: Picture | None = None

    def add(self, picture: Picture, count: int) -> None:
        """Show a picture so many times: longer, where it is the last one again."""
        if self._last is not None and np.array_equal(picture, self._last):
            self._shown_ms[-1] += count * self._picture_ms
            return
        self._last = picture
        self._pictures.append(_Packed(picture))
        self._shown_ms.append(count * self._picture_ms)

    def finish(self) -> None:
        """Write the file."""
        palette = _palette_of(self._pictures)
        first, *others = (
            Image.fromarray(packed.picture()).quantize(palette=palette, dither=Image.Dither.NONE)
            for packed in self._pictures
        )
        first.save(
            self._path, "GIF", save_all=True, append_images=others, duration=self._shown_ms, loop=0, optimize=True
        )

    def stop(self) -> None:
        """Do nothing: the file is written at once, or not at all."""


class _Packed:
    """A picture in little memory."""

    def __init__(self, picture: Picture) -> None:
        self.shape = picture.shape
        self._packed = zlib.compress(picture.tobytes(), 1)

    def picture(self) -> Picture:
        return np.frombuffer(zlib.decompress(self._packed), np.uint8).reshape(self.shape)


def _palette_of(pictures: list[_Packed]) -> Image.Image:
    """Return the colours that are drawn, which no window may crowd out, and the ones that the pictures need most."""
    chosen = _sample_of(pictures).quantize(CHOSEN).getpalette() or []
    palette = Image.new("P", (1, 1))
    palette.putpalette([value for colour in (*DRAWN, *EDGES) for value in colour] + chosen[: 3 * CHOSEN])
    return palette


def _sample_of(pictures: list[_Packed]) -> Image.Image:
    """Return all pictures below each other, of each as many rows as there is room for."""
    height, width, _ = pictures[0].shape
    every = -(-width * height * len(pictures) // SAMPLE)
    return Image.fromarray(np.concatenate([each.picture()[at % every :: every] for at, each in enumerate(pictures)]))
