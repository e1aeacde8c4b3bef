"""The live view in a terminal (Textual): it reads what a run publishes, and passes on what a person asks of it.

Each of its panels is drawn by a function, and only where something in it has changed.
"""

import contextlib
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import ClassVar, NamedTuple

from rich.text import Text
from textual.app import App, ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Container
from textual.events import Resize
from textual.widget import Widget
from textual.widgets import Footer

from mc_nested.errors import RunError
from mc_nested.view import panels
from mc_nested.view.files import (
    FOLDER,
    NOW,
    PAUSE,
    STOP,
    TAKEOVER,
    Scrubber,
    YesOrNo,
    ask,
    ask_to_go_on,
    give_answer,
    history_of,
    is_published,
    renew_pause,
    status_now,
)
from mc_nested.view.words import Life, StatusShown, life_of

Draw = Callable[[StatusShown, int, int], Text]
"""Draws what is shown in so many columns and lines."""


class Panel(Widget):
    """Shows what ``draw`` makes of the status, as large as it is."""

    def __init__(self, draw: Draw, *, id: str) -> None:  # noqa: A002 - Textual's name
        super().__init__(id=id)
        self._draw = draw
        self._shown: StatusShown | None = None
        self._text = Text()

    def show(self, shown: StatusShown) -> None:
        """Show a status, if it differs from the one shown."""
        self._shown = shown
        text = self._draw(shown, self.size.width, self.size.height)
        if text != self._text or text.spans != self._text.spans:
            self._text = text
            self.refresh()

    def on_resize(self, _: Resize) -> None:
        """Draw it again, for its new size."""
        if self._shown is not None:
            self.show(self._shown)

    def render(self) -> Text:
        """Return the text."""
        return self._text


LOOK_EVERY_S = 0.3

LIFE_EVERY_S = 2.0
"""Seconds between two looks whether the run's process lives."""

NARROW = 72
"""Columns below which arena and side stand one below the other."""

LEAST_STATUS = 2
"""Lines of what the run does: more, where a question needs them."""

CLOSES_AFTER_S = 0.5
"""Seconds for which a view that closes at the end shows it."""


class _Layout(NamedTuple):
    """What the places of the parts depend on; laying out anew costs as much as drawing twenty times."""

    is_narrow: bool
    status_lines: int
    arena_size: int | None


class ViewApp(App[None]):
    """The view of a run.

    Args:
        folder: the run's folder.
        closes_at_end: whether it closes by itself once the run has ended.
        clock: seconds since 1970.
    """

    TITLE = "mc-nested"
    ENABLE_COMMAND_PALETTE = False
    CSS = """
    #title, #moment { height: 1; }
    #body { layout: horizontal; height: 1fr; }
    #arena { width: 1fr; height: 100%; }
    #side { width: 1fr; height: 100%; margin-left: 2; }
    #body.narrow { layout: vertical; }
    #body.narrow #arena { width: 100%; }
    #body.narrow #side { width: 100%; height: 1fr; margin-left: 0; }
    #body.bare #arena { display: none; }
    """
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("p", "pause", "pause, go on"),
        Binding("t", "take_over", "take over, give back"),
        Binding("s", "stop", "stop"),
        Binding("ctrl+c", "interrupt", "stop", show=False, priority=True),
        Binding("q", "quit", "close"),
        Binding("ctrl+q", "quit", "close", show=False, priority=True),
        Binding("left", "move(-1)", "back"),
        Binding("right", "move(1)", "on"),
        Binding("pageup,shift+left", "jump(-1)", "far back", show=False),
        Binding("pagedown,shift+right", "jump(1)", "far on", show=False),
        Binding("home", "first", "first", show=False),
        Binding("end", "now", "now"),
        Binding("escape", "now", "now", show=False),
        Binding("y", "answer(True)", "yes"),
        Binding("n", "answer(False)", "no"),
    ]

    def __init__(self, folder: Path, *, closes_at_end: bool = False, clock: Callable[[], float] = time.time) -> None:
        super().__init__()
        self._folder = folder
        self._closes_at_end = closes_at_end
        self._clock = clock
        self._status = status_now(folder)
        self._changed_at = 0
        self._lives = is_published(folder)
        self._look_at_life = 0.0
        self._past: Scrubber | None = None
        self._pauses = False
        self._layout: _Layout | None = None
        self._offered: object = None

    def compose(self) -> ComposeResult:
        """Return the parts, from top to bottom."""
        yield Panel(panels.title, id="title")
        yield Panel(panels.status_lines, id="status")
        with Container(id="body"):
            yield Panel(panels.arena, id="arena")
            yield Panel(lambda shown, width, height: panels.side_panel(shown.status, width, height), id="side")
        yield Panel(self._moment, id="moment")
        yield Footer()

    def on_mount(self) -> None:
        """Begin to look for changes."""
        self._draw()
        self.set_interval(LOOK_EVERY_S, self._look)

    def on_resize(self, event: Resize) -> None:
        """Lay it out anew."""
        del event
        self._draw()

    @property
    def shown(self) -> StatusShown:
        """What is shown now: the status now, or one of the past."""
        if self._past:
            return StatusShown(self._past.status, self._past.status.at, "runs", is_past=True)
        return StatusShown(self._status, self._clock(), self._life)

    @property
    def _life(self) -> Life:
        return life_of(self._status, self._lives, self._clock())

    def action_pause(self) -> None:
        """Ask to pause, or to go on."""
        status = self._status
        self._pauses = not (self._pauses or status.paused or status.pausing)
        self._ask(partial(ask, PAUSE) if self._pauses else ask_to_go_on)

    async def action_quit(self) -> None:
        """Close; the pause that this view asked for ends."""
        if self._pauses:
            with contextlib.suppress(OSError):
                ask_to_go_on(self._folder)
        self.exit()

    def check_action(self, action: str, parameters: tuple[object, ...]) -> bool | None:
        """Return whether a key can do anything now: others aren't offered."""
        if action == "pause":
            return self._life == "runs" and self._status.can_pause
        if action == "take_over":
            return self._life == "runs" and self._status.can_take_over
        if action == "stop":
            return self._life == "runs"
        if action == "answer":
            return self._life == "runs" and self._status.question is not None and self._past is None
        return super().check_action(action, parameters)

    async def action_interrupt(self) -> None:
        """Stop the run at Ctrl+C where this view is its own; else close the view."""
        if self._closes_at_end and self._life == "runs":
            self.action_stop()
        else:
            await self.action_quit()

    def action_stop(self) -> None:
        """Ask to stop, as Ctrl+C does in the run's terminal."""
        self._ask(partial(ask, STOP))

    def action_take_over(self) -> None:
        """Let the player take over, or give back."""
        self._ask(partial(ask, TAKEOVER))

    def action_answer(self, is_yes: bool) -> None:
        """Answer the run's question, if it has one and that is on the screen."""
        answer = YesOrNo(number=self._status.question_number, is_yes=is_yes)
        self._ask(lambda folder: give_answer(folder, answer))

    def action_move(self, places: int) -> None:
        """Show the moment so many places after, or before for a negative number."""
        self._scrub(lambda past: past.moved(places))

    def action_jump(self, tenths: int) -> None:
        """Go so many tenths of the run on, or back for a negative number."""
        self._scrub(lambda past: past.jumped(tenths))

    def action_first(self) -> None:
        """Show the first moment."""
        self._scrub(lambda past: past.moved(-len(past.history)))

    def action_now(self) -> None:
        """Show what is now."""
        self._past = None
        self._draw()

    def _scrub(self, move: Callable[[Scrubber], Scrubber]) -> None:
        if self._past is None:
            history = history_of(self._folder)
            if not history:
                return
            self._past = Scrubber(history, len(history) - 1)
        self._past = move(self._past)
        self._draw()

    def _ask(self, request: Callable[[Path], None]) -> None:
        try:
            request(self._folder)
        except OSError as error:
            self.notify(f"the run can't be asked: {error.strerror or error}", severity="error", markup=False)

    def _look(self) -> None:
        try:
            changed_at = (self._folder / FOLDER / NOW).stat().st_mtime_ns
            if changed_at != self._changed_at:
                self._status, self._changed_at = status_now(self._folder), changed_at
        except (OSError, RunError):  # it is being replaced, or its folder is gone: the next look tells
            pass
        now = self._clock()
        if now >= self._look_at_life:
            self._lives, self._look_at_life = is_published(self._folder), now + LIFE_EVERY_S
        if self._pauses:
            self._pauses = renew_pause(self._folder)
        self._draw()
        if self._closes_at_end and self._life != "runs":
            self._closes_at_end = False
            self.set_timer(CLOSES_AFTER_S, self.exit)

    def _draw(self) -> None:
        shown = self.shown
        if (layout := self._layout_for(shown)) != self._layout:
            self._layout = layout
            self._lay_out(layout)
        status = self._status
        offered = (self._life, status.can_pause, status.can_take_over, status.question, self._past is None)
        if offered != self._offered:
            self._offered = offered
            self.refresh_bindings()
        for panel in self.query(Panel):
            panel.show(shown)

    def _layout_for(self, shown: StatusShown) -> _Layout:
        width, height = self.size
        lines = len(panels.status_lines(shown, width, height).split("\n"))
        arena = shown.status.arena
        return _Layout(
            is_narrow=width < NARROW,
            status_lines=min(max(LEAST_STATUS, lines), height // 2),
            arena_size=arena.size if arena else None,
        )

    def _lay_out(self, layout: _Layout) -> None:
        """Lay the parts out: arena and side stand side by side where there is room; a long status gets its lines."""
        body = self.query("#body")
        body.set_class(layout.is_narrow, "narrow")
        body.set_class(layout.arena_size is None, "bare")
        self.query("#arena").set_styles(height=layout.arena_size if layout.is_narrow and layout.arena_size else "100%")
        self.query("#status").set_styles(height=layout.status_lines)

    def _moment(self, shown: StatusShown, width: int, height: int) -> Text:
        return self._past.line(width) if self._past else panels.moment(shown, width, height)
