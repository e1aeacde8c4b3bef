"""Recorder keeps a live run in a folder, in files of a minute, while the run goes on.

The thread that plays only sets calls down. A thread of its own packs and writes them four times a second, so a run that
is killed has lost less than its last second. Where the disk refuses, the recording ends, and the run goes on.

A run hands it its devices, screens and notes, and uses what it gets back.
"""

import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path

from mc_nested.live.devices import Devices
from mc_nested.live.input.stops import Stop
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.live.recording.call_encoder import CallEncoder
from mc_nested.live.recording.format import SUFFIX, Tape
from mc_nested.live.recording.recorded_devices import RecordedScreen, recorded
from mc_nested.live.recording.recording_file import PartWriter, TimedCall
from mc_nested.live.vision.game_screen import GameScreen, WindowScreen

WRITE_EVERY_S = 0.25

PART_S = 60.0
"""Seconds of one file: what is dropped at once when a recording is full."""

KEPT_S = 30 * 60.0
KEPT_BYTES = 500_000_000
"""How much of a run is kept: its last half hour, or so many bytes."""


class Recorder:
    """Sits between a run and its window, as a context manager: records what passes, and the notes of a journal.

    Args:
        folder: a new or empty one, for the recording's files.
        facts: what the recording is of, as texts by name.
        size: the window's width and height.
        say: shows the person one line, where the disk refuses.

    Raises OSError where the folder can't be made.
    """

    def __init__(
        self, folder: Path, facts: Mapping[str, str], size: tuple[int, int], say: Callable[[str], None]
    ) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder = folder
        self.tape = Tape()
        self._facts = dict(facts)
        self._say = say
        self._encoder = CallEncoder(size)
        self._part: PartWriter | None = None
        self._part_began = 0.0
        self._closed: list[tuple[float, Path]] = []
        self._count = 0
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)

    def devices(self, devices: Devices) -> Devices:
        """Return the same devices, recorded."""
        return recorded(devices, self.tape)

    def screen(self, screen: GameScreen) -> GameScreen:
        """Return the same screen, recorded."""
        if not isinstance(screen, WindowScreen):
            return screen
        self._encoder.font = screen.font
        return RecordedScreen(screen, self.tape)

    def stopping(self, stop: Stop) -> Stop:
        """Return what stops the run by a person's will, recorded. It may be called by any thread."""

        def stop_and_say(reason: str) -> None:
            self.tape.add("stop", reason)
            stop(reason)

        return stop_and_say

    def hands(self, whose: str, is_so: bool) -> bool:
        """Record that the player has taken over, or given back, where the thread that plays notices; return that."""
        if is_so:
            self.tape.add("hands", whose)
        return is_so

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Record a note of the journal."""
        self.tape.add("note", kind, facts)

    def __enter__(self) -> "Recorder":
        self._thread.start()
        return self

    def __exit__(self, _: object, error: BaseException | None, *__: object) -> None:
        if error is not None:
            self.tape.add("error", "run", type(error).__name__, str(error))
        self._ended.set()
        self._thread.join()

    def _run(self) -> None:
        try:
            while not self._ended.wait(WRITE_EVERY_S):
                self._write()
            self._write()
            if self._part is not None:
                self._part.close()
        except OSError as error:
            self._say(f"the recording ends here, the run goes on: {self.folder}: {error.strerror or error}")
            if self._part is not None:
                self._part.abandon()
            while not self._ended.wait(WRITE_EVERY_S):
                self.tape.take()

    def _write(self) -> None:
        calls = [TimedCall(at, *self._encoder.encode(call)) for at, call in self.tape.take()]
        if calls:
            self._current_part().write(calls)

    def _current_part(self) -> PartWriter:
        """Return the file to write to; a new one, without what is too old, once the last one is long enough."""
        now = time.monotonic()
        if self._part is not None and now - self._part_began < PART_S:
            return self._part
        if self._part is not None:
            part, self._part = self._part, None
            self._closed.append((now, part.path))
            part.close()
            self._drop_old(now)
        self._count += 1
        self._part = PartWriter(self.folder / f"{self._count:05d}{SUFFIX}", self._facts)
        self._part_began = now
        return self._part

    def _drop_old(self, now: float) -> None:
        sizes = [path.stat().st_size for _, path in self._closed]
        while self._closed and (sum(sizes) > KEPT_BYTES or now - self._closed[0][0] > KEPT_S):
            _, path = self._closed.pop(0)
            sizes.pop(0)
            path.unlink()
