"""A picture of a film: the arena from above, its step and its score, and beside it the game's window, if it has one."""

from functools import lru_cache
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont, ImageOps

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import COLOURS, Colour, Picture, draw_objective, draw_picture
from mc_nested.arena.env import ArenaEnv

Size = tuple[int, int]
"""Width and height in pixels."""

ARENA_PX, SMALL_ARENA_PX = 390, 210
"""The side of the square that the arena lies in, in a film and in a small one: 26 and 14 pixels a cell of 15."""

MARGIN = 16
STEP_PX = 72
"""Pixels that the step's number may take."""
CAPTION = 60
"""Pixels above the arena, for two lines of text."""

PAPER: Colour = (252, 252, 250)
INK: Colour = (33, 37, 41)
PALE_INK: Colour = (96, 104, 112)

DRAWN: tuple[Colour, ...] = (PAPER, INK, PALE_INK, *COLOURS)
"""The colours that are drawn here; what lies between two of them is an edge."""

BOLD, PLAIN = ("DejaVuSans-Bold.ttf", 15), ("DejaVuSans.ttf", 12)
"""A font's file and its size in pixels; matplotlib brings them."""

LINES = 12, 36
"""Where the lines of text begin, from the top."""

WINDOW = "the window; grey: the chat's place"


def draw_moment(env: ArenaEnv, objective: Cell | None = None, arena_px: int = ARENA_PX) -> Picture:
    """Draw the arena from above, (height, width, 3), below the design's name, the step, the blocks and the score.

    The score is r_M if the episode ended now. The objective, the cell that the agent is after, is framed.
    """
    scenario = env.scenario
    paper = np.full((arena_px + CAPTION + MARGIN, arena_px + 2 * MARGIN, 3), PAPER, dtype=np.uint8)
    arena = draw_picture(scenario, env.cell, env.placed, arena_px // scenario.size)
    if objective is not None:
        draw_objective(arena, scenario.size, objective, arena_px // scenario.size)
    unused = (arena_px - len(arena)) // 2
    top, left = CAPTION + unused, MARGIN + unused
    paper[top : top + len(arena), left : left + len(arena)] = arena
    name = f"{scenario.name}, in {env.material}"
    built = len(scenario.design & env.placed)
    score = f"{env.score:g} of {scenario.optimum:g}"
    image = Image.fromarray(paper)
    pen = ImageDraw.Draw(image)
    right, (upper, lower) = MARGIN + arena_px, LINES
    pen.text((MARGIN, upper), _fitting(name, _font(*BOLD), arena_px - STEP_PX), INK, _font(*BOLD))
    pen.text((right, upper + 2), f"step {env.steps}", PALE_INK, _font(*PLAIN), anchor="ra")
    pen.text((MARGIN, lower), f"{built} of {scenario.blocks} blocks", PALE_INK, _font(*PLAIN))
    pen.text((right, lower), f"score {score}", PALE_INK, _font(*PLAIN), anchor="ra")
    return np.asarray(image)


def box_for(window: Picture, arena_px: int = ARENA_PX) -> Size:
    """Return the width and height that a window's picture gets beside the arena: as high as the arena."""
    height, width = window.shape[:2]
    return max(1, round(arena_px * width / height)), arena_px


def beside(picture: Picture, window: Picture, box: Size) -> Picture:
    """Return a moment's picture, and to its right the window's, scaled to fit a box (width, height), its shape kept.

    So a window that changes its size doesn't change the film's.
    """
    width, height = box
    paper = Image.new("RGB", (picture.shape[1] + width + MARGIN, picture.shape[0]), PAPER)
    paper.paste(Image.fromarray(picture), (0, 0))
    fitted = ImageOps.contain(Image.fromarray(window), box, Image.Resampling.BILINEAR)
    left = picture.shape[1] + (width - fitted.width) // 2
    paper.paste(fitted, (left, CAPTION + (height - fitted.height) // 2))
    words = _fitting(WINDOW, _font(*PLAIN), width)
    ImageDraw.Draw(paper).text((picture.shape[1], LINES[1]), words, PALE_INK, _font(*PLAIN))
    return np.asarray(paper)


def _fitting(text: str, font: ImageFont.FreeTypeFont, width: int) -> str:
    """Return the text, or as much of its beginning as the width has room for."""
    if font.getlength(text) <= width:
        return text
    return next(
        short for end in range(len(text), -1, -1) if font.getlength(short := f"{text[:end].rstrip()}…") <= width
    )


@lru_cache(maxsize=2)
def _font(file: str, size: int) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(Path(matplotlib.get_data_path(), "fonts", "ttf", file)), size)
