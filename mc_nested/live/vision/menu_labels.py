"""Menus read by their labels: a button is found by the shadowed text on it. Never a guess.

A label counts where each of its dots has a label's colour and its shadow, and nothing beside it has that colour. The
outline of a button must lie 6 dots above it and 5 below (FACTS: Screens and their buttons).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.vision.covered_label import CoveredLabels
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, dots_of
from mc_nested.live.vision.layout import DISABLED, INK_SPREAD, PLAIN, UNDER_MOUSE, WHITE, Colour
from mc_nested.live.vision.overlay import SCALES

_COLOURS = (WHITE, PLAIN, UNDER_MOUSE, DISABLED)
_LEAST = (min(PLAIN) - INK_SPREAD, min(DISABLED) - INK_SPREAD)
"""Least green of a label that can be pressed, and of any label: the button behind it has 152 at most."""

_ABOVE, _BELOW, _BESIDE = 7, 7, 7
"""Dots around a label that are looked at: to just outside the button, and farther than a space and a gap are wide."""


@dataclass(frozen=True)
class MenuButton:
    """A button's ``middle`` (x, y) in pixels of the frame, or None with the ``problem``: never a guess.

    A grey one can't be pressed now: its ``middle`` is known, and ``is_enabled`` is False. ``scale`` is the GUI scale
    that it is drawn at.
    """

    middle: tuple[int, int] | None = None
    is_enabled: bool = False
    problem: str | None = None
    scale: int = 1


@dataclass(frozen=True)
class _Label:
    """A text's colours and the dots around it: (rows, columns, 3) from ``_ABOVE`` and ``_BESIDE`` before it on."""

    middle: tuple[int, int]
    scale: int
    colour: Colour
    around: NDArray[np.int16]


class MenuLabels:
    """A frame (height, width, 3), blue green red, of a menu; without ``scale`` each of ``SCALES`` is tried.

    With ``is_under_text`` the debug screen may lie over a label: one in the middle of the window is known by what
    shows of it.
    """

    def __init__(self, frame: Frame, font: Font, scale: int | None = None, *, is_under_text: bool = False) -> None:
        self._font = font
        self._is_under_text = is_under_text
        scales = SCALES if scale is None else (scale,)
        self._dots = [GlyphGrid(frame, each, least) for each in scales for least in _LEAST]
        self._covered_labels = [CoveredLabels(each) for each in self._dots[:: len(_LEAST)]]

    def shows(self, text: str) -> bool:
        """Return whether a shadowed text, a button's or not, stands there with nothing beside it."""
        return bool(self._labels(text))

    def button(self, label: str) -> MenuButton:
        """Return the one button with this label.

        Raises:
            FontError: the font lacks a character of the label.
        """
        labels = self._labels(label)
        buttons = [seen for seen in labels if _is_on_a_button(seen.around)]
        if len(buttons) == 1:
            return MenuButton(buttons[0].middle, buttons[0].colour != DISABLED, scale=buttons[0].scale)
        if self._is_under_text and not buttons and (covered := self._covered(label, labels)):
            return covered
        if buttons:
            return MenuButton(problem=f"{len(buttons)} buttons read {label!r}: close what lies over the menu")
        if labels:
            return MenuButton(
                problem=f"{label!r} is to be seen, but on no button: use the game's own look of its buttons"
            )
        return MenuButton(problem=f"no button {label!r} is to be seen: is this menu open, and nothing over it?")

    def _covered(self, label: str, labels: list[_Label]) -> MenuButton | None:
        """Return a button that the debug screen covers: its edges alone, or a part of its label.

        ``labels`` are those that are seen whole.
        """
        if len(labels) == 1:
            return MenuButton(labels[0].middle, labels[0].colour != DISABLED, scale=labels[0].scale)
        columns = self._font.columns(label)[:-1]
        for covered in self._covered_labels:
            if found := covered.find(columns):
                (x, y), scale = found.middle, covered.dots.scale
                return MenuButton((x * scale, y * scale), found.is_enabled, scale=scale)
        return None

    def _labels(self, text: str) -> list[_Label]:
        columns = self._font.columns(text)
        bits = dots_of(columns)
        seen: dict[tuple[int, int], _Label] = {}
        for dots in self._dots:
            for row, column in dots.find(columns[:-1]):
                middle = (int((column + len(columns) / 2) * dots.scale), (row + GLYPH_ROWS // 2) * dots.scale)
                around = _around(dots, row, column, len(columns))
                if around is not None and (colour := _colour_of(around, bits)):
                    seen[middle] = _Label(middle, dots.scale, colour, around)
        return list(seen.values())


def _around(dots: GlyphGrid, row: int, column: int, width: int) -> NDArray[np.int16] | None:
    """Return the colours of a text's dots and those around it; None where they aren't all in the frame."""
    step, middle = dots.scale, dots.scale // 2
    first, left = row - _ABOVE, column - _BESIDE
    rows, columns = GLYPH_ROWS + _ABOVE + _BELOW, width + 2 * _BESIDE
    if first < 0 or left < 0:
        return None
    picked = dots.frame[first * step + middle :: step, left * step + middle :: step][:rows, :columns]
    return picked[..., ::-1].astype(np.int16) if picked.shape[:2] == (rows, columns) else None


def _colour_of(around: NDArray[np.int16], bits: NDArray[np.bool_]) -> Colour | None:
    """Return the label's colour, if the text has it everywhere, and nothing beside; None if not."""
    rows, columns = around.shape[:2]
    ink = np.zeros((rows, columns), bool)
    ink[_ABOVE : rows - _BELOW, _BESIDE : columns - _BESIDE] = bits
    shadow = np.roll(ink, (1, 1), (0, 1)) & ~ink
    for colour in _COLOURS:
        like = _alike(around, colour)
        cast = _alike(around, (colour[0] >> 2, colour[1] >> 2, colour[2] >> 2))
        beside = np.concatenate((like[_ABOVE:-_BELOW, :_BESIDE], like[_ABOVE:-_BELOW, -_BESIDE:]), 1)
        if like[ink].all() and cast[shadow].all() and not beside.any():
            return colour
    return None


def _alike(around: NDArray[np.int16], colour: Colour) -> NDArray[np.bool_]:
    return np.asarray((np.abs(around - colour) <= INK_SPREAD).all(2))


def _is_on_a_button(around: NDArray[np.int16]) -> bool:
    """Return whether a line of one colour, with another colour on one side, lies at each of a button's two edges."""
    upper, lower = around[_ABOVE - 6], around[_ABOVE + 13]
    is_flat = np.ptp(np.concatenate((upper, lower)), axis=0).max() <= INK_SPREAD
    return bool(
        is_flat
        and _is_edge(around[_ABOVE - 7], upper, around[_ABOVE - 5])
        and _is_edge(around[_ABOVE + 12], lower, around[_ABOVE + 14])
    )


def _is_edge(before: NDArray[np.int16], line: NDArray[np.int16], behind: NDArray[np.int16]) -> bool:
    return any((np.abs(near - line).max(1) > 2 * INK_SPREAD).mean() > 0.9 for near in (before, behind))
