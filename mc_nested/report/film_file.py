"""Write a film as .gif, by Pillow, or as .mp4, by the ffmpeg that imageio-ffmpeg brings."""

import contextlib
import re
import subprocess
import tempfile
import zlib
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import numpy as np
from PIL import Image

from mc_nested.arena.drawing import Picture
from mc_nested.errors import FilmError, with_extra
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


H264 = ("-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-pix_fmt", "yuv420p")
"""What every player knows; quick, since a game is played beside it."""


def check_ffmpeg() -> str:
    """Return the path of ffmpeg; FilmError, one line that names the extra, where there is none."""
    try:
        import imageio_ffmpeg
    except ImportError:
        raise FilmError(f"an .mp4 film needs imageio-ffmpeg, a .gif doesn't: {with_extra('video')}") from None
    try:
        program: str = imageio_ffmpeg.get_ffmpeg_exe()
    except RuntimeError:
        raise FilmError("an .mp4 film needs ffmpeg, and there is none: install it, or name a .gif") from None
    return program


class Mp4Encoder:
    """Writes an .mp4. A picture with an odd number of pixels gets another row or column.

    A thread pipes the pictures: Ctrl+C, which the main thread gets, never leaves a part of one in the pipe.

    Args:
        path: the file.
        fps: pictures a second.
        whole_every: after so many pictures one is written whole again, which others are read from.
    """

    def __init__(self, path: Path, fps: int, whole_every: int = 250) -> None:
        self._path, self._fps, self._whole_every = path, fps, whole_every
        self._ffmpeg: subprocess.Popen[bytes] | None = None
        # Not a pipe: that could fill up while pictures are written, since nobody reads it then.
        self._said = tempfile.TemporaryFile()  # noqa: SIM115 - closed by stop
        self._thread = ThreadPoolExecutor(1, "film")
        self._piping: Future[None] | None = None

    def add(self, picture: Picture, count: int) -> None:
        """Show a picture so many times; OSError where ffmpeg gave up on an earlier one."""
        height, width = picture.shape[:2]
        even = np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
        if self._ffmpeg is None:
            self._ffmpeg = self._started(even.shape[1], even.shape[0])
        self._wait()
        self._piping = self._thread.submit(_pipe, self._ffmpeg, even.tobytes(), count)

    def finish(self) -> None:
        """End the film; OSError with ffmpeg's last line where it could not write all of it."""
        self._wait()
        if self._ffmpeg is not None and _end(self._ffmpeg):
            raise OSError(self._last_line())

    def stop(self) -> None:
        """End ffmpeg, if it still runs, and leave its file as it is."""
        if self._ffmpeg is not None and self._ffmpeg.poll() is None:
            self._ffmpeg.kill()
        self._thread.shutdown()
        if self._ffmpeg is not None:
            _end(self._ffmpeg)
        self._said.close()

    def _wait(self) -> None:
        """Wait until the last picture is piped."""
        try:
            if self._piping is not None:
                self._piping.result()
        except OSError:
            if self._ffmpeg is not None:
                self._ffmpeg.wait()
            raise OSError(self._last_line()) from None

    def _started(self, width: int, height: int) -> "subprocess.Popen[bytes]":
        pictures = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{self._fps}", "-i", "-"]
        written = [*H264, "-g", f"{self._whole_every}", "-movflags", "+faststart", "-f", "mp4", "-y", f"{self._path}"]
        return subprocess.Popen(  # noqa: S603 - imageio-ffmpeg's
            [check_ffmpeg(), "-v", "error", *pictures, *written],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=self._said,
            # Ctrl+C is this program's, which ends the film then.
            start_new_session=True,
            creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
        )

    def _last_line(self) -> str:
        self._said.seek(0)
        lines = self._said.read().decode(errors="replace").splitlines()
        return re.sub(r"^(\[[^\]]*\] *)+", "", lines[-1]) if lines else "ffmpeg ended without a word"


def _pipe(ffmpeg: "subprocess.Popen[bytes]", picture: bytes, count: int) -> None:
    if ffmpeg.stdin:
        for _ in range(count):
            ffmpeg.stdin.write(picture)


def _end(ffmpeg: "subprocess.Popen[bytes]") -> int:
    """Send no more pictures: ffmpeg's exit code."""
    if ffmpeg.stdin:
        with contextlib.suppress(OSError):
            ffmpeg.stdin.close()
    return ffmpeg.wait()
