"""Replay: today's reader and body on a recording: where they would read or decide otherwise.

Each reading is taken anew from its pixels and compared; play goes on with the one of then. Each call to a device must
be the recorded one, to the last digit of its time. After the first that is another, nothing can be known of that
episode any more, and the next reset is where both are alike again.
"""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import parse_scenario
from mc_nested.errors import DesktopError, LiveError, RecordingError
from mc_nested.live.connection import GameConnection, overlay_of
from mc_nested.live.devices import Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.input.stops import Takeover
from mc_nested.live.live_game import LiveGame
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.motion.person import STOPPED
from mc_nested.live.profile.store import parse_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.recording_file import Lost, facts_of, read_recording
from mc_nested.live.recording.replayed_devices import OtherCall, ReplayedTape, replayed
from mc_nested.live.recording.replayed_screen import PixelReader, ReplayedScreen
from mc_nested.live.vision.font import Font

NOTHING = np.zeros((1, 1, 3), np.uint8)
"""A picture of no point: it is like nothing."""


@dataclass(frozen=True)
class Difference:
    """A call at which this version reads or decides otherwise.

    Attributes:
        action: the number of actions that had begun.
        kind: a reading, or a decision.
        then: what was recorded, in words.
        now: what this version does.
        picture: what it was read from, for a reading.
    """

    action: int
    kind: str
    then: str
    now: str
    picture: Frame | None = None


@dataclass
class Replayed:
    """The results of a replay. Readings whose pixels were not kept are not among ``read_anew``."""

    actions: int = 0
    followed: int = 0
    readings: int = 0
    read_anew: int = 0
    damaged: list[str] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)


def profile_of(path: Path, facts: Mapping[str, str]) -> Profile:
    """Return the profile of a recording that says these facts of itself.

    Raise RecordingError if it can't be replayed with it.
    """
    try:
        return parse_profile(facts["profile"], f"{path}: its profile")
    except KeyError:
        raise RecordingError(f"{path}: says nothing of its profile: it can't be replayed") from None


def replay(path: Path, font: Font) -> Replayed:
    """Replay a recording's file or folder, read with that font.

    Raise RecordingError if it is foreign, of another format or holds nothing.
    """
    return _Player(path, font).play()


class _Player:
    def __init__(self, path: Path, font: Font) -> None:
        facts = facts_of(path)
        profile = profile_of(path, facts)
        self.seen = Replayed()
        width, height = (int(each) for each in facts["size"].split("x"))
        self._pixels = PixelReader((width, height), font, overlay_of(profile))
        self._tape = ReplayedTape(self._calls(path))
        self._screen = ReplayedScreen(self._tape, self._pixels, self._compare)
        devices = replayed(self._tape, (width, height), facts.get("title", ""))
        self._controller = InputController(devices, profile.input, self._tape.hands)
        self._tape.on_release = self._controller.was_released
        connection = GameConnection(
            devices,
            self._controller,
            self._screen,
            is_server_allowed=facts.get("is_server_allowed") == "true",
            journal=self._tape,
        )
        self._game = None
        if "scenario" in facts:
            scenario = parse_scenario(facts["scenario"], f"{path}: its scenario")
            # Their pictures aren't recorded: a screen that was known by one of them can't be followed.
            points = {name: ClickPoint(name, at, NOTHING) for name, at in profile.points.items()}
            stopped = ["note", "fails", {"problem": STOPPED}]
            takeover = Takeover(is_stopped=lambda: self._tape.peek() == stopped)
            self._game = LiveGame(
                scenario,
                profile,
                connection,
                points=points,
                restore=lambda _world, _template: None,
                takeover=takeover,
            )

    def play(self) -> Replayed:
        while (call := self._tape.peek()) is not None:
            if self._game is not None and call[:2] == ["note", "resets"]:
                self._follow(self._game, call[2])
            else:
                self._pass_by(call)
        return self.seen

    def _follow(self, game: LiveGame, facts: Mapping[str, Any]) -> None:
        """Follow one episode: its reset, and its actions until the next one, or until the first call that differs."""
        tape = self._tape
        placed = [(int(x), int(y)) for x, y in facts["placed"]]
        real, imaginary, weight = facts["tick_phase"]
        chat = [(float(sent), int(lines)) for sent, lines in facts["chat"]]
        game.go_on_from(placed, facts["pressed"], (real, imaginary, weight), chat)
        tape.is_followed = True
        try:
            with suppress(LiveError, DesktopError):  # as it was then, or its note would have differed
                game.reset(int(facts["material"]))
            while (call := tape.peek()) is not None and call[:2] != ["note", "resets"]:
                if call[:2] != ["note", "acts"]:
                    self._pass_by(call)
                    continue
                self.seen.actions += 1
                facts = call[2]
                following = (Action(then[0]), then[1]) if (then := facts.get("following")) else None
                with suppress(LiveError, DesktopError):
                    game.act(Action(facts["action"]), facts.get("material"), following)
                self.seen.followed += 1
        except OtherCall as other:
            if tape.peek() is not None and tape.stop_reason is None and not self._was_ended():
                self._differs("decision", _words(other.then), _words(other.now))
        finally:
            tape.is_followed = False

    def _was_ended(self) -> bool:
        """Return whether the run ended here, as by Ctrl+C: what was held was released, and nothing else was done."""
        while (call := self._tape.peek()) is not None and call[1] == "release":
            self._tape.skip()
        return call is not None and call[:2] == ["error", "run"]

    def _pass_by(self, call: list[Any]) -> None:
        """Pass by a call; compare nothing but its reading."""
        self._tape.skip()
        if call[:2] == ["note", "acts"]:
            self.seen.actions += 1
        elif call[0] == "screen" and call[1] in ("read", "read_position"):
            self._screen.read_again(call[1], call[3], call[4])

    def _compare(self, then: Any, now: Any | None) -> None:
        self.seen.readings += 1
        if now is None:
            return
        self.seen.read_anew += 1
        if then != now:
            self._differs("reading", str(then[0]), str(now[0]), np.array(self._pixels.canvas))

    def _differs(self, kind: str, then: str, now: str, picture: Frame | None = None) -> None:
        self.seen.differences.append(Difference(self.seen.actions, kind, then, now, picture))

    def _calls(self, path: Path) -> Iterator[list[Any]]:
        for each in read_recording(path):
            if isinstance(each, Lost):
                self.seen.damaged.append(each.what)
                continue
            self._pixels.pictures.extend(each.pictures)
            yield each.call


def _words(call: list[Any] | None) -> str:
    return "nothing more" if call is None else " ".join(str(each) for each in call)
