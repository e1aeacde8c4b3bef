"""The tables of a profile, one class each: their keys, defaults, limits and what they mean."""

import math
import re
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from mc_nested.arena.rules import SIZE, Cell
from mc_nested.errors import ProfileError
from mc_nested.live import coordinates
from mc_nested.live.beat import FELT_AFTER_S, SEEN_AFTER_S
from mc_nested.live.coordinates import Facing
from mc_nested.live.desktop.keys import check_key
from mc_nested.live.reading import Block
from mc_nested.live.walk import INERTIA, SNEAKING, walk_response

Dialect = Literal["1.12", "1.13", "1.17"]
"""The first version of each syntax that the commands came in (FACTS: Commands)."""

FILL_LIMIT = 32768
"""Blocks that one /fill may change (FACTS: Commands)."""

FORMAT: Literal[1] = 1
"""Of a profile: one more wherever a key gets another meaning, or goes."""

Seconds = Annotated[float, Field(gt=0, le=60)]
Latency = Annotated[float, Field(ge=0, le=0.5)]
Fraction = Annotated[float, Field(ge=0, le=1)]
Shade = Annotated[int, Field(ge=0, le=255)]
Key = Annotated[str, Field(min_length=1)]


class ProfileTable(BaseModel):
    """A table that knows its keys, takes nothing else, and never changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Window(ProfileTable):
    """Which window is the game's."""

    title: str = Field(
        default=r"^Minecraft\*? \d", description="a regular expression that is found in the title of the game's window"
    )

    @field_validator("title")
    @classmethod
    def _is_an_expression(cls, title: str) -> str:
        try:
            re.compile(title)
        except re.error as error:
            raise ValueError(f"not a regular expression ({error}): mend it, or write a part of the title") from error
        return title

    def matches(self, title: str) -> bool:
        """Whether a window of this title is the game's."""
        return re.search(self.title, title) is not None


class GameVersion(ProfileTable):
    """Which Minecraft this is."""

    version: Annotated[str, Field(pattern=r"^\d+\.\d+(\D.*)?$")] = Field(
        default="1.21", description="the game's version, as its title screen says"
    )

    @property
    def dialect(self) -> Dialect:
        """The syntax of this version's commands; years (26.1) are newer than 1.21."""
        major, minor = (int(part) for part in re.findall(r"\d+", self.version)[:2])
        if (major, minor) < (1, 13):
            return "1.12"
        return "1.13" if (major, minor) < (1, 17) else "1.17"


class Keys(ProfileTable):
    """Which key does what in this game: one character, or a word such as enter, f3, left.shift."""

    forward: Key = "w"
    back: Key = "s"
    left: Key = "a"
    right: Key = "d"
    sneak: Key = Field(default="left.shift", description="slow steps")
    chat: Key = "t"
    debug: Key = Field(default="f3", description="turns the debug screen on")
    panic: Key = Field(default="f12", description="stops the agent at once, whichever window is in front")
    hotbar: Annotated[tuple[Key, ...], Field(min_length=9, max_length=9)] = Field(
        default=tuple("123456789"), description="the keys of the nine hotbar slots, from the left"
    )

    @field_validator("*")
    @classmethod
    def _are_keys(cls, names: str | tuple[str, ...]) -> str | tuple[str, ...]:
        try:
            for name in (names,) if isinstance(names, str) else names:
                check_key(name)
        except ProfileError as error:
            raise ValueError(str(error)) from error
        return names


class Screen(ProfileTable):
    """How the debug screen is drawn. Without a GUI scale, all of it is found on the screen, for scales 1 to 4."""

    font: str | None = Field(
        default=None,
        description="the game's own client jar, a resource pack or an ascii.png: a whole path, or one from ~",
    )
    gui_scale: Annotated[int, Field(ge=1, le=16)] | None = Field(
        default=None, description="screen pixels to a dot of the font; left out, it is found on the screen"
    )
    line_pitch: Annotated[int, Field(ge=8, le=20)] | None = Field(
        default=None,
        description="dots from one line to the next; counts beside gui_scale only, the game's 9 if left out",
    )
    text_colour: tuple[Shade, Shade, Shade] | None = Field(
        default=None,
        description="red, green, blue of the text; counts beside gui_scale only, the game's 224 224 224 if left out",
    )

    @field_validator("font")
    @classmethod
    def _is_a_whole_path(cls, font: str | None) -> str | None:
        if font is not None and not Path(font).expanduser().is_absolute():
            raise ValueError(f"{font!r} depends on where you are: write the whole path, or one from ~")
        return font

    def font_path(self) -> Path:
        """Where the font is read from; ProfileError where the profile doesn't say."""
        if self.font is None:
            raise ProfileError("screen.font is missing: write the path of your game's client jar into the profile")
        return Path(self.font).expanduser()


class Arena(ProfileTable):
    """Where the arena lies in the world."""

    origin: Block = Field(
        description="the block of cell (0, 0), as x, y, z: y is the level of the feet",
    )
    facing: Facing = Field(
        description="the way the agent looks: where the cells' y grows",
    )
    marked: tuple[Block, Block] = Field(
        description="two opposite corners of the blocks that a reset may clear; nothing outside is ever touched"
    )
    copied_to: Block | None = Field(
        default=None,
        description="the lowest corner of the copy of what stood there before: what calibrate arena --undo puts back",
    )

    @model_validator(mode="after")
    def _is_marked(self) -> "Arena":
        low, high = self.region
        corners = (self.block_of((0, 0)), self.block_of((SIZE - 1, SIZE - 1)))
        if any(not low[axis] <= corner[axis] <= high[axis] for corner in corners for axis in range(3)):
            raise ValueError("the marked blocks don't hold the whole arena: run mc-nested calibrate arena")
        if low[1] < self.origin[1]:
            raise ValueError("the marked blocks reach below the feet, into the floor: run mc-nested calibrate arena")
        if math.prod(high[axis] - low[axis] + 1 for axis in range(3)) > FILL_LIMIT:
            raise ValueError(
                f"more than {FILL_LIMIT} blocks are marked, too many for the game to clear at once: mark fewer"
            )
        return self

    @classmethod
    def around(cls, origin: Block, facing: Facing, height: int = 2) -> "Arena":
        """The arena that starts at ``origin``, its cells marked ``height`` blocks up: 2 is as tall as the player."""
        x, y, z = coordinates.block_of(origin, facing, (SIZE - 1, SIZE - 1))
        return cls(origin=origin, facing=facing, marked=(origin, (x, y + height - 1, z)))

    @property
    def region(self) -> tuple[Block, Block]:
        """The lowest and the highest corner of the marked blocks, both inside."""
        one, other = self.marked
        return (
            (min(one[0], other[0]), min(one[1], other[1]), min(one[2], other[2])),
            (max(one[0], other[0]), max(one[1], other[1]), max(one[2], other[2])),
        )

    @property
    def yaw(self) -> float:
        """The yaw, in degrees, of the agent."""
        return coordinates.yaw_of(self.facing)

    def block_of(self, cell: Cell) -> Block:
        """The block that fills a cell."""
        return coordinates.block_of(self.origin, self.facing, cell)

    def centre_of(self, cell: Cell) -> tuple[float, float, float]:
        """Where the agent's feet are in the middle of a cell."""
        return coordinates.centre_of(self.origin, self.facing, cell)

    def place_of(self, xyz: tuple[float, float, float]) -> tuple[float, float]:
        """Where ``xyz`` lies in cells, as (right, forward), a cell's middle being whole numbers."""
        return coordinates.place_of(self.origin, self.facing, xyz)


class World(ProfileTable):
    """A world without cheats: a reset leaves it, restores its folder from a copy, and enters it again by clicks."""

    folder: str = Field(description="the world's folder in the game's saves; it must hold a file mc-nested-arena.txt")
    template: str = Field(
        description="a copy of that folder, elsewhere, with the agent on the start cell, looking the arena's way and "
        "body.pitch down, and the scenario's blocks in the hotbar"
    )
    name: str = Field(description="the world's name, as the list of worlds shows it")

    @field_validator("folder", "template")
    @classmethod
    def _is_a_whole_path(cls, path: str) -> str:
        if not Path(path).expanduser().is_absolute():
            raise ValueError(f"{path!r} depends on where you are: write the whole path, or one from ~")
        return path


class Blocks(ProfileTable):
    """How this game names blocks."""

    shown_prefix: str = Field(
        default="minecraft:",
        description="what the debug screen writes before a block's name",
    )
    names: dict[str, str] = Field(
        default_factory=dict, description="this game's name of a scenario's block, where it has another one"
    )


class Input(ProfileTable):
    """How long keys and buttons are pressed, in seconds."""

    click_s: Annotated[float, Field(gt=0, lt=0.2)] = Field(
        default=0.08,
        description="length of a click; at 0.2 s the game would place a second block",
    )
    chat_open_s: Seconds = Field(
        default=0.2,
        description="from the chat key until the chat takes text",
    )
    chat_close_s: Seconds = Field(
        default=0.5,
        description="from Enter until the game takes keys and clicks again",
    )
    reads_chat: bool = Field(
        default=True,
        description="whether the chat's line is looked at before and after typing; false where it isn't drawn as the "
        "game does it",
    )


class Body(ProfileTable):
    """How the agent moves and places: lengths in blocks, times in seconds."""

    pitch: Annotated[float, Field(gt=51.2, lt=72.8)] = Field(
        default=65.0, description="degrees that the agent looks down: at 65 a click lands on the floor of the next cell"
    )
    tolerance: Annotated[float, Field(ge=0.11, le=0.2)] = Field(
        default=0.15, description="how far off a cell's middle the agent may stand when it places"
    )
    settle_s: Seconds = Field(
        default=0.15,
        description="a position that stays the same for so long, after coasting, is standstill",
    )
    confirm_s: Seconds = Field(
        default=1.5,
        description="how long a placed block may take to be seen before the next click",
    )
    patience_s: Seconds = Field(
        default=5.0,
        description="how long the debug screen may stay unreadable, or a move go on",
    )
    tries: Annotated[int, Field(ge=1, le=50)] = Field(
        default=8,
        description="presses for one move, and clicks for one block",
    )


class Walk(ProfileTable):
    """How far a held key walks."""

    covered: Annotated[tuple[float, ...], Field(min_length=4)] = Field(
        default=tuple(round(blocks, 4) for blocks in walk_response(12)),
        description="blocks covered by 1, 2, 3 ... ticks held, until standstill",
    )
    inertia: Annotated[float, Field(gt=0, lt=1)] = Field(
        default=INERTIA, description="what a tick leaves of a step: 0.546 on stone"
    )
    sneaking: Annotated[float, Field(gt=0, lt=1)] = Field(
        default=SNEAKING, description="what sneaking leaves of a step that a key adds"
    )
    felt_after_s: Latency = Field(
        default=FELT_AFTER_S, description="seconds from a press until the game has it, on average"
    )
    seen_after_s: Latency = Field(
        default=SEEN_AFTER_S, description="seconds from a tick until its step is on the screen, on average"
    )

    @field_validator("covered")
    @classmethod
    def _grows(cls, covered: tuple[float, ...]) -> tuple[float, ...]:
        if any(after <= before for before, after in zip((0.0, *covered), covered, strict=False)):
            raise ValueError("must grow with every tick: measure it again, or remove it to take the default")
        return covered


class Calibrated(ProfileTable):
    """What the profile was calibrated on, and when; written by calibration, checked before it is played with."""

    format: Literal[1] = Field(
        default=FORMAT, description="of this file: another version of mc-nested may know another one"
    )
    date: str = Field(description="the day, as year-month-day")
    version: str | None = Field(default=None, description="the version that the game's window said")
    window: tuple[int, int] | None = Field(default=None, description="the window's width and height in pixels")
    gui_scale: Annotated[int, Field(ge=1, le=16)] | None = Field(
        default=None, description="screen pixels to a dot of the font, as seen"
    )
    samples: dict[str, int] = Field(
        default_factory=dict, description="how many measurements each step rests on, by its name"
    )
