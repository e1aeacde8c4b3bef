"""The guided run: what each step gets, what ends it, what is passed over, and what is never written."""

import contextlib
from dataclasses import dataclass, field

import pytest

from calibration.run_steps import Guided, Run, Step, run_steps
from calibration.step import Bench, Found
from mc_nested.errors import (
    LiveError,
    McNestedError,
    NotConfirmedError,
    NotInFrontError,
    ProfileError,
    StoppedError,
    UserError,
)
from mc_nested.live.desktop import Desktop
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import GameVersion, Input, Keys
from sim.client.client import VirtualClient


@dataclass
class Watcher:
    """Notes what the run says of itself."""

    said: list[object] = field(default_factory=list)

    def begin(self, name: str, number: int, of: int) -> None:
        self.said.append((name, number, of))

    def end(self, found: Found, seconds: float) -> None:
        self.said.append((found.lines, round(seconds, 6)))

    def passed_over(self, reason: str, seconds: float) -> None:
        self.said.append((reason, round(seconds, 6)))


class Room:
    """A virtual client with a bench before it, and somebody who notes which way back was looked for."""

    def __init__(self) -> None:
        self.client = VirtualClient()
        self.watcher = Watcher()
        self.ways_back: list[Profile] = []
        client = self.client
        desktop = Desktop(client.display, client.keyboard, client.pointer, client.clock, client.clipboard)
        hands = Hands(client.display, client.keyboard, client.pointer, client.clock, Input())
        self.bench = Bench(desktop, hands, lambda _: None, lambda _: True)

    def run(self, *steps: Step, profile: Profile | None = None) -> Guided:
        return run_steps(steps, self.bench, profile or Profile(), self.watcher, self.ways_back.append)


def sets(**tables: object) -> Run:
    """A step that takes a second and finds these tables."""

    def run(bench: Bench, profile: Profile) -> Found:
        bench.desktop.clock.sleep_until(bench.desktop.clock.now() + 1)
        return Found("+".join(tables), profile.model_copy(update=tables), (f"found {', '.join(tables)}",), 1)

    return run


def fails(error: BaseException) -> Run:
    """A step that fails after half a second, a key still down."""

    def run(bench: Bench, _profile: Profile) -> Found:
        bench.hands.saw("world")
        bench.hands.press(bench.desktop.clock.now() + 2, "w")
        bench.desktop.clock.sleep_until(bench.desktop.clock.now() + 0.5)
        raise error

    return run


OLD = GameVersion(version="1.12.2")
SWAPPED = Keys(left="d", right="a")


def test_each_step_stands_on_what_the_one_before_found() -> None:
    room = Room()
    seen: list[Profile] = []

    def last(_bench: Bench, profile: Profile) -> Found:
        seen.append(profile)
        return Found("last", profile, (), 0)

    guided = room.run(Step("game", sets(game=OLD)), Step("keys", sets(keys=SWAPPED)), Step("last", last))
    assert guided.profile == seen[0] == Profile(game=OLD, keys=SWAPPED)
    assert [found.step for found in guided.found] == ["game", "keys", "last"]
    assert guided.passed_over == {}
    assert room.watcher.said == [
        ("game", 1, 3),
        (("found game",), 1.0),
        ("keys", 2, 3),
        (("found keys",), 1.0),
        ("last", 3, 3),
        ((), 0.0),
    ]


@pytest.mark.parametrize("error", [NotConfirmedError("no"), ProfileError("no")])
def test_a_needed_step_that_fails_ends_the_run_and_names_itself(error: McNestedError) -> None:
    room = Room()
    with pytest.raises(type(error), match=r"^walk: no \(the profile is as it was\)$"):
        room.run(Step("walk", fails(error)), Step("never", fails(AssertionError())))
    assert room.ways_back == []


@pytest.mark.parametrize("error", [LiveError("no such button"), UserError("no such button")])
def test_a_step_that_nothing_stands_on_is_passed_over_and_the_world_found_again(error: McNestedError) -> None:
    room = Room()
    guided = room.run(
        Step("game", sets(game=OLD)), Step("clicks", fails(error), is_needed=False), Step("keys", sets(keys=SWAPPED))
    )
    assert guided.profile == Profile(game=OLD, keys=SWAPPED)
    assert [found.step for found in guided.found] == ["game", "keys"]
    assert guided.passed_over == {"clicks": "no such button"}
    assert ("no such button", 0.5) in room.watcher.said
    assert room.ways_back == [Profile(game=OLD)]


@pytest.mark.parametrize("error", [NotInFrontError("behind"), StoppedError("the panic key was pressed")])
def test_whoever_takes_the_game_away_ends_the_run_whatever_the_step(error: McNestedError) -> None:
    with pytest.raises(type(error), match="clicks: "):
        Room().run(Step("clicks", fails(error), is_needed=False), Step("never", fails(AssertionError())))


@pytest.mark.parametrize("is_needed", [True, False])
@pytest.mark.parametrize("error", [NotConfirmedError("no"), KeyboardInterrupt(), StoppedError("stop")])
def test_no_key_stays_down_however_a_step_ends(error: BaseException, is_needed: bool) -> None:
    room = Room()
    with contextlib.suppress(LiveError, KeyboardInterrupt):
        room.run(Step("walk", fails(error), is_needed=is_needed))
    assert not room.client.window.down
