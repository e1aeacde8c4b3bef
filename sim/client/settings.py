"""The settings of a virtual client."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mc_nested.live.vision.font import Font
from mc_nested.live.vision.layout import Scales, largest_gui_scale
from sim.client.game.debug_entries import TUTORIAL, DebugEntries
from sim.client.game.edition import Edition
from sim.client.game.options import GameOptions
from sim.client.game.physics import Vector
from sim.client.game.realm import Mode

Size = tuple[int, int]
"""A window's width and height in framebuffer pixels."""


@dataclass(frozen=True)
class ClientSettings:
    """The settings of a virtual client. Two clients of the same settings, used alike, behave the same to the bit.

    ``size`` is in framebuffer pixels, ``scale`` the GUI scale asked for (0 is auto, None that of ``options``).
    ``world`` is the kind of world behind the text, of ``painter.WORLDS``, bright or dark, or ``painter.SEEN``: what
    the player sees. ``shown_fps`` are the frames a second that the debug screen names; None for ``fps``. ``font``
    is the project's own if it is None. Latencies are from and to, in seconds: until an event reaches the game, and
    the age of a picture. ``feet``, ``yaw`` and ``pitch`` are where the player starts, and restarts after a death:
    looking at the ground, as a calibration asks for. ``debug_entries`` are what the debug screen shows from 1.21.9
    on: as our tutorial asks, which is the game's default and the block looked at. ``slipperiness`` is the floor's,
    ``speed`` an effect's factor on every push. With ``swaps_sides``, A goes right and D left. ``layout`` is the
    keyboard's, of ``keyboard.LAYOUTS``. ``words`` are the menus' texts in another language, by their English. With a
    ``world_folder`` the world is written into it whenever it is left, and read from it when it is entered.
    """

    seed: int = 0
    version: str = "1.20.1"
    size: Size = (854, 480)
    scale: int | None = 2
    world: str = "noise"
    font: Font | None = None
    fps: float = 60.0
    shown_fps: float | None = None
    input_latency_s: tuple[float, float] = (0.005, 0.020)
    capture_latency_s: tuple[float, float] = (0.010, 0.030)
    feet: Vector = (0.5, 64.0, 0.5)
    yaw: float = 0.0
    pitch: float = 40.0
    floor_block: str = "bedrock"
    mode: Mode = "creative"
    has_cheats: bool = True
    has_f3: bool = True
    debug_entries: DebugEntries = field(default_factory=lambda: TUTORIAL)
    options: GameOptions = field(default_factory=GameOptions)
    slipperiness: float = 0.6
    speed: float = 1.0
    swaps_sides: bool = False
    layout: str = "us"
    world_folder: Path | None = None
    words: Mapping[str, str] = field(default_factory=dict)


def gui_scale(size: Size, wanted: int) -> int:
    """Return the GUI scale that a window of that size gets: the one asked for, or the largest below it that fits.

    0 asks for the largest that fits (FACTS: The F3 debug screen).
    """
    largest = largest_gui_scale(size)
    return min(wanted, largest) if wanted else largest


def scales(size: Size, wanted: int, wanted_debug: int, edition: Edition) -> Scales:
    """Return the scales of a window of that size; ``wanted_debug`` is ``debugGuiScale`` (FACTS: The F3 debug screen).

    From 26.3 on that is 0 for half of the largest that fits, or a scale; it counts where it is below the GUI scale.
    """
    gui = gui_scale(size, wanted)
    debug = wanted_debug or largest_gui_scale(size) // 2
    return Scales(gui, debug if edition.since(26, 3) and 0 < debug < gui else gui)
