"""What the steps of a calibration share: what they work with, and what they leave.

Each step is a function: it takes a bench and a profile, looks and presses, and returns the profile with what it found,
beside what a person wants to see of it. It writes no file; whoever runs it does, once all of it is good.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.live.click_points import ClickPoint
from mc_nested.live.desktop import Desktop
from mc_nested.live.devices import Frame
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile


@dataclass(frozen=True)
class Bench:
    """The devices, the one owner of held keys, and the person: told something, or asked for a yes."""

    desktop: Desktop
    hands: Hands
    say: Callable[[str], None]
    ask: Callable[[str], bool]


@dataclass(frozen=True)
class Picture:
    """A picture for a person, (height, width, 3) blue green red, of the game's window or drawn; and what it shows."""

    title: str
    frame: Frame
    note: str = ""


@dataclass(frozen=True)
class Found:
    """What a step found: the profile with it, one line for each thing, the measurements it rests on, and pictures.

    ``points`` are places to click that were recorded: their own pictures are written beside the profile.
    """

    step: str
    profile: Profile
    lines: tuple[str, ...]
    samples: int
    pictures: tuple[Picture, ...] = ()
    points: tuple[ClickPoint, ...] = ()
