"""The game's bitmap font: from the user's own ``ascii.png`` to an exact table of glyphs (FACTS: The bitmap font).

The picture is 16 x 16 cells of 8 x 8 dots; a cell's row is the character's code divided by 16, its column the rest.
A glyph is kept as one byte a column, from the pen's position to its last used column: bit ``r`` is the dot in row
``r``. The pen moves on by the last used column + 2, and by 4 for a space.
"""

import io
import string
import struct
import warnings
import zipfile
import zlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from mc_nested.arrays import Bytes
from mc_nested.errors import FontError, PictureError
from mc_nested.live.devices import Frame

ENTRY = "assets/minecraft/textures/font/ascii.png"
SPACE = 4
"""Columns that a space moves the pen by (FACTS: The bitmap font)."""

Glyph = tuple[str, int, int]
"""A character, the blank columns on its left, and the columns from its first ink to its last."""

_GIVE = "give the game's jar (versions/1.20.1/1.20.1.jar in its folder), a resource pack or its ascii.png"
_FORMATS = ("PNG", "JPEG", "BMP", "WEBP", "TIFF")
_CELLS = 16
_DOTS = 8
_NEEDED = string.digits + string.ascii_letters + ".,:/-()_#"
_NUMERIC = string.digits + "-.,:/"


@dataclass(frozen=True)
class Font:
    """The printable ASCII glyphs of one bitmap font: the columns of each character, from the pen to the last used one.

    ``glyphs`` has neither the space nor any character that is blank in the picture.
    """

    glyphs: Mapping[str, bytes]

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash(frozenset(self.glyphs.items()))

    @cached_property
    def lookup(self) -> Mapping[bytes, Glyph]:
        """From a glyph's columns, its blank left ones taken away, to the glyph.

        Characters that look alike are left out, so that neither is ever read as the other. So is a glyph with a gap
        inside whose left part is a glyph too, and that part: ``"`` may be two ``'``.
        """
        inked = {char: columns.lstrip(b"\0") for char, columns in self.glyphs.items()}
        alike = Counter(inked.values())
        gapped = {columns for columns in inked.values() if b"\0" in columns}
        parts = {columns.split(b"\0")[0] for columns in gapped} & set(inked.values())
        doubtful = parts | {columns for columns in gapped if columns.split(b"\0")[0] in parts}
        return {
            columns: (char, len(self.glyphs[char]) - len(columns), len(columns))
            for char, columns in inked.items()
            if alike[columns] == 1 and columns not in doubtful
        }

    @cached_property
    def gapped(self) -> Mapping[bytes, Glyph]:
        """Glyphs of ``lookup`` with a gap inside, the widest first. None begins with columns that are a glyph too."""
        widest_first = sorted(self.lookup.items(), key=lambda item: -len(item[0]))
        return {columns: glyph for columns, glyph in widest_first if b"\0" in columns}

    def columns(self, text: str) -> bytes:
        """Return a line of text as columns, its last one blank; its length is the width that the game gives it.

        Raises:
            FontError: the text holds a character that the font doesn't have.
        """
        missing = sorted({char for char in text if char not in self.glyphs and char != " "})
        if missing:
            raise FontError(f"the font has no glyph for {''.join(missing)!r}: take the ascii.png of the game's own jar")
        return b"".join(b"\0" * SPACE if char == " " else self.glyphs[char] + b"\0" for char in text)


def load_font(path: Path) -> Font:
    """Return the font of an ``ascii.png``, or of a client jar, a resource pack (zip) or a resource pack's folder.

    A picture of n x 128 dots a side is scaled down, if each of its dots is n x n pixels.

    Raises:
        FontError: there is nothing that can be used; the message says what to give instead.
    """
    try:
        picture = _rgba(_picture_bytes(path))
    except PictureError as error:
        raise FontError(f"{path} {error}: {_GIVE}") from None
    if picture[..., 3].all():
        raise FontError(f"{path} has no transparency, so glyphs and background can't be separated: give the game's jar")
    return font_of(picture, str(path))


def decoded(data: bytes) -> Frame:
    """Return the pixels of a picture file as a frame.

    Raises:
        PictureError: it is none, is damaged, or is larger by what it says than any screen; without the file's name.
    """
    return np.array(_rgba(data)[..., 2::-1], np.uint8)


def _rgba(data: bytes) -> Bytes:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(file := io.BytesIO(data), formats=_FORMATS) as image:
                image.verify()  # its checksums, which aren't looked at afterwards
            with Image.open(file, formats=_FORMATS) as image:
                return np.asarray(image.convert("RGBA"), np.uint8)
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        raise PictureError("has more pixels than any screen") from None
    except (OSError, SyntaxError, ValueError, EOFError, struct.error):
        raise PictureError("is not a picture, or is damaged") from None


def font_of(atlas: Bytes, name: str = "the font picture") -> Font:
    """Return the font of an atlas (n * 128, n * 128, 4), whose last channel is alpha: 0 or 255.

    Raises:
        FontError: the atlas has another size, is finer than 8 x 8 dots a glyph, or lacks glyphs that F3 needs.
    """
    dots = _dots(atlas[..., 3], name)
    glyphs = {}
    for code in range(ord("!"), ord("~") + 1):
        top, left = (index * _DOTS for index in divmod(code, _CELLS))
        cell = dots[top : top + _DOTS, left : left + _DOTS]
        columns = np.packbits(cell, axis=0, bitorder="little").tobytes().rstrip(b"\0")
        if columns:
            glyphs[chr(code)] = columns
    font = Font(glyphs)
    _check(font, name)
    return font


def _dots(alpha: Bytes, name: str) -> NDArray[np.bool_]:
    """Return the atlas's alpha channel as 128 x 128 dots, each drawn or not."""
    side, finer = alpha.shape[0], alpha.shape[0] // (_CELLS * _DOTS)
    if alpha.shape != (side, side) or side == 0 or side % (_CELLS * _DOTS):
        width, height = alpha.shape[1], alpha.shape[0]
        raise FontError(f"{name} is {width} x {height} pixels: a font picture is 128 x 128, or a multiple of it")
    drawn = alpha > 127
    dots = drawn[::finer, ::finer]
    if not np.array_equal(drawn, dots.repeat(finer, 0).repeat(finer, 1)):
        raise FontError(
            f"{name} draws finer than 8 x 8 dots a glyph, which can't be read: take that pack off in the game's "
            "options, and give the game's own jar"
        )
    return np.asarray(dots)


def _check(font: Font, name: str) -> None:
    missing = "".join(char for char in _NEEDED if char not in font.glyphs)
    if missing:
        raise FontError(f"{name} has no glyph for {missing}: give the game's jar, or its ascii.png")
    known = {char for char, *_ in font.lookup.values()}
    alike = "".join(char for char in _NUMERIC if char not in known)
    if alike:
        raise FontError(
            f"{name} draws {alike} like other characters: take that pack off in the game's options, and give the "
            "game's own jar"
        )


def _picture_bytes(path: Path) -> bytes:
    try:
        if path.is_dir():
            path = path / ENTRY
        elif zipfile.is_zipfile(path):
            with zipfile.ZipFile(path) as archive:
                return archive.read(ENTRY)
        return path.read_bytes()
    except KeyError:
        raise FontError(f"{path} holds no {ENTRY}: give the jar in the game's versions folder") from None
    except FileNotFoundError:
        raise FontError(f"there is no {path}: {_GIVE}") from None
    # What zipfile raises for a jar that is cut off, damaged, packed in a way it doesn't know, or encrypted.
    except (OSError, EOFError, zipfile.BadZipFile, zlib.error, RuntimeError) as error:
        raise FontError(f"{path} can't be read ({error}): {_GIVE}") from None
