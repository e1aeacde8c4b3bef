"""How exactly and how fast the debug screen is read, on painted frames of all layouts, GUI scales, windows and worlds.

Frames come in pairs: the second shows the player a tick later before another world. A new reader reads the first
("cold"), then the second, where it remembers where the lines stood ("warm"). Warm times are of frames that needed no
second look, each read five times more. Times are medians of processor time at 1920 x 1080 on one core;
``workload_ms`` is a fixed piece of NumPy work, to compare machines. Where Tesseract is installed, it is given the XYZ
line of some of these frames, cut out, black on white, enlarged and smoothed; it is right if the three numbers are. Its
time is wall clock, process start included. Right are no wrong reading and at most 0.1 % that were not read; 0.5 % if
26.4's layout is among them.
"""

import argparse
import dataclasses
import itertools
import os
import re
import shutil
import statistics
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeVar

import cv2
import numpy as np
from rich.console import Console
from rich.progress import track

from mc_nested.errors import UserError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import Font, font_of, load_font
from mc_nested.live.vision.overlay import POSITION, find_debug_screen
from mc_nested.live.vision.screen_reader import ScreenReader
from mc_nested.live.vision.text_lines import positions_of
from scripts.bench import Figures
from scripts.benches.f3_cases import expected, frames
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.drawing.painter import WORLDS, random_world
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS

WINDOWS = ((854, 480), (1280, 720), (1366, 768), (1600, 900), (1920, 1080))
FULL_HD = (1080, 1920)
TICK_BLOCKS = 0.216
"""How far a walking player gets in a tick (FACTS: Walking)."""

REREADS = 5
"""How often a warm frame is read again for its time, as while waiting for the next tick."""

T = TypeVar("T")

_NUMBER = re.compile(r"-?\d+[.,]\d+")


@dataclasses.dataclass(frozen=True)
class Result:
    """Counts, milliseconds at 1920 x 1080, and the share of lines that Tesseract read.

    None where there was no such frame, or no Tesseract.
    """

    frames: int
    wrong: int
    unread: int
    warm_ms: float | None
    cold_ms: float | None
    workload_ms: float
    tesseract_frames: int
    tesseract_accuracy: float | None
    tesseract_ms: float | None


class OneFrameDisplay:
    """A Display that shows one frame."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.whole_grabs = 0

    def size(self) -> tuple[int, int]:
        return self.frame.shape[1], self.frame.shape[0]

    def title(self) -> str:
        return "Minecraft"

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        if region is None:
            self.whole_grabs += 1
            return self.frame
        return self.frame[region.top : region.top + region.height, region.left : region.left + region.width]


def read_frames(
    font: Font, count: int, seed: int, tesseract_count: int, layouts: tuple[Layout, ...] = LAYOUTS
) -> Result:
    """Read ``count`` painted frames of layouts, an even number, and give Tesseract ``tesseract_count`` of them."""
    wrong = unread = 0
    cold: list[float] = []
    warm: list[float] = []
    tesseract: list[tuple[bool, float]] = []
    every = max(1, count // 2 // tesseract_count) if tesseract_count and shutil.which("tesseract") else 0
    cases = track(pairs(font, seed, count // 2, layouts), "reading", total=count // 2, console=Console(stderr=True))
    for index, (first, second) in enumerate(cases):
        display = OneFrameDisplay(first[1])
        reader = ScreenReader(display, font)
        for times, (screen, frame) in ((cold, first), (warm, second)):
            display.frame, display.whole_grabs = frame, 0
            reading, seconds = _timed(reader.read)
            if times is warm and display.whole_grabs == 0:
                seconds = statistics.median(_timed(reader.read)[1] for _ in range(REREADS))
            unread += reading.problem is not None
            wrong += reading.problem is None and reading != expected(screen)
            if frame.shape[:2] == FULL_HD and display.whole_grabs == (times is cold):
                times.append(seconds)
        if every and index % every == 0 and len(tesseract) < tesseract_count:
            tesseract += tesseract_reads(font, *first)
    return Result(
        frames=count // 2 * 2,
        wrong=wrong,
        unread=unread,
        warm_ms=_median_ms(warm),
        cold_ms=_median_ms(cold),
        workload_ms=workload_ms(),
        tesseract_frames=len(tesseract),
        tesseract_accuracy=round(statistics.mean(right for right, _ in tesseract), 4) if tesseract else None,
        tesseract_ms=_median_ms([seconds for _, seconds in tesseract]),
    )


def pairs(
    font: Font, seed: int, count: int, layouts: tuple[Layout, ...] = LAYOUTS
) -> Iterator[tuple[tuple[F3Screen, Frame], tuple[F3Screen, Frame]]]:
    """Yield painted screens with their frames, each with the one a tick later."""
    rng = np.random.default_rng(seed)
    for screen, frame in itertools.islice(frames(font, seed, WINDOWS, layouts), count):
        x, y, z = screen.xyz
        later = dataclasses.replace(screen, xyz=(x + TICK_BLOCKS, y, z))
        world = random_world(rng, str(rng.choice(WORLDS)), frame.shape[1], frame.shape[0])
        yield (screen, frame), (later, paint(world, later, font))


def tesseract_reads(font: Font, screen: F3Screen, frame: Frame) -> list[tuple[bool, float]]:
    """Return whether Tesseract reads this frame's XYZ line, and the seconds it takes; nothing if there is no line."""
    found = find_debug_screen(frame, font)
    if found is None or found.label != POSITION:
        return []
    row, column = positions_of(found.dots, font, POSITION)[0]
    xyz = expected(screen).xyz or ()
    numbers = [f"{value:.{decimals}f}" for value, decimals in zip(xyz, _decimals(screen), strict=True)]
    scale, wide = screen.gui_scale, len(font.columns(f"{POSITION} {' / '.join(numbers)}"))
    line = frame[max(0, row - 2) * scale : (row + 10) * scale, max(0, column - 3) * scale : (column + wide + 3) * scale]
    start = time.perf_counter()
    text = subprocess.run(
        ["tesseract", "stdin", "stdout", "--psm", "7"],  # noqa: S607 - wherever the system has it
        input=cv2.imencode(".png", _for_tesseract(line, scale))[1].tobytes(),
        capture_output=True,
        check=True,
        env={**os.environ, "OMP_THREAD_LIMIT": "1"},
    ).stdout.decode()
    read = [number.replace(",", ".") for number in _NUMBER.findall(text.replace(" ", ""))]
    return [(read == numbers, time.perf_counter() - start)]


def workload_ms() -> float:
    """Return the milliseconds for sorting the rows of a 1080 x 1920 picture: the same work on every machine."""
    picture = np.random.default_rng(0).integers(0, 256, FULL_HD, np.uint8)
    return _median_ms([_timed(lambda: np.sort(picture, axis=1))[1] for _ in range(9)]) or 0.0


def _decimals(screen: F3Screen) -> tuple[int, int, int]:
    return (3, 3 if screen.layout == "standin" else 5, 3)


def _for_tesseract(line: Frame, scale: int) -> Frame:
    """Return letters 28 pixels high: of several ways to prepare lines, Tesseract read most of them this way."""
    ink = cv2.inRange(line, (220,) * 3, (255,) * 3)
    large = cv2.resize(cv2.bitwise_not(ink), None, fx=4 / scale, fy=4 / scale, interpolation=cv2.INTER_NEAREST)
    framed = cv2.copyMakeBorder(large, 20, 20, 20, 20, cv2.BORDER_CONSTANT, value=(255,))
    return np.asarray(cv2.GaussianBlur(framed, (0, 0), 2), np.uint8)


def _timed(read: Callable[[], T]) -> tuple[T, float]:
    start = time.process_time()
    result = read()
    return result, time.process_time() - start


def _median_ms(seconds: list[float]) -> float | None:
    return round(1000 * statistics.median(seconds), 3) if seconds else None


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--frames", type=int, default=20_000)
    parser.add_argument("--layout", nargs="+", choices=LAYOUTS, default=LAYOUTS, help="all if left out")
    parser.add_argument("--font", type=Path, help="a font picture, jar or resource pack; without it the drawn font")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--tesseract", type=int, default=200, help="frames for Tesseract, if it is installed")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Read so many frames."""
    if options.frames < 2:
        raise UserError("--frames must be at least 2")
    cv2.setNumThreads(1)
    font = load_font(options.font) if options.font else font_of(drawn_atlas())
    result = read_frames(font, options.frames, options.seed, options.tesseract, tuple(options.layout))
    bound = 0.005 if "26.4" in options.layout else 0.001
    return dataclasses.asdict(result), result.wrong == 0 and result.unread <= bound * result.frames
