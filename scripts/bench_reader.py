"""How well and how fast the F3 reader reads painted frames of all layouts, GUI scales, window sizes and worlds.

    python scripts/bench_reader.py [--frames 1000] [--font PNG_OR_JAR] [--seed 0] [--json]

Prints the frames read wrong and not read, and the median processor time of a 1920 x 1080 frame on one core, with the
overlay yet to be found ("cold") and with it known. Exit code 1 if a reading was wrong or more than 1 % were not read.
"""

import argparse
import itertools
import json
import statistics
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path

import cv2
from rich.console import Console
from rich.progress import track

from mc_nested.errors import UserError
from mc_nested.live.debug_screen import Overlay, find_overlay, read_debug_screen
from mc_nested.live.devices import Frame
from mc_nested.live.font import Font, font_of, load_font
from mc_nested.live.reading import Reading
from sim.client.f3_cases import expected, frames
from sim.client.font import drawn_atlas

FULL_HD = (1080, 1920)


@dataclass(frozen=True)
class Result:
    """What the frames gave: counts, and milliseconds of processor time a 1920 x 1080 frame, None without any."""

    frames: int
    wrong: int
    unread: int
    full_hd_cold_ms: float | None
    full_hd_known_ms: float | None


def measure(font: Font, count: int, seed: int) -> Result:
    """Read ``count`` painted frames, and time those of full HD."""
    wrong = unread = 0
    cold: list[float] = []
    known: list[float] = []
    cases = itertools.islice(frames(font, seed), count)
    for screen, frame in track(cases, "reading", total=count, console=Console(stderr=True)):
        reading, seconds = _timed(frame, font, None)
        unread += reading.problem is not None
        wrong += reading.problem is None and reading != expected(screen)
        if frame.shape[:2] == FULL_HD:
            cold.append(seconds)
            known.append(_timed(frame, font, find_overlay(frame, font))[1])
    return Result(count, wrong, unread, _median_ms(cold), _median_ms(known))


def _timed(frame: Frame, font: Font, overlay: Overlay | None) -> tuple[Reading, float]:
    start = time.process_time()
    reading = read_debug_screen(frame, font, overlay)
    return reading, time.process_time() - start


def _median_ms(seconds: list[float]) -> float | None:
    return round(1000 * statistics.median(seconds), 3) if seconds else None


def main() -> int:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(description="How well and how fast the F3 reader reads painted frames.")
    parser.add_argument("--frames", type=int, default=1000)
    parser.add_argument("--font", type=Path, help="a font picture, jar or resource pack; without it the drawn font")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.frames < 1:
        parser.error("--frames must be at least 1")
    cv2.setNumThreads(1)
    try:
        font = load_font(arguments.font) if arguments.font else font_of(drawn_atlas())
    except UserError as error:
        parser.error(str(error))
    result = measure(font, arguments.frames, arguments.seed)
    print(json.dumps(asdict(result)) if arguments.json else _words(result))
    return int(result.wrong > 0 or result.unread * 100 > result.frames)


def _words(result: Result) -> str:
    return (
        f"{result.frames} frames: {result.wrong} wrong, {result.unread} not read; a 1920 x 1080 frame takes "
        f"{result.full_hd_cold_ms} ms cold, {result.full_hd_known_ms} ms with the overlay known (medians, one core)"
    )


if __name__ == "__main__":
    sys.exit(main())
