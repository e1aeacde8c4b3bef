"""Profile: everything known about one user's game and screen, one class per table: keys, defaults, limits, meanings.

A key that is left out takes its default, or is found on the screen.
"""

import re
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, field_validator, model_validator

from mc_nested.errors import ProfileError
from mc_nested.live.model.keys import canonical, check_key
from mc_nested.live.model.kinematics import INERTIA, SNEAKING, walk_response
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, INPUT_LATENCY_S
from mc_nested.live.model.versions import GAME_TITLE, is_minecrafts, version_numbers
from mc_nested.live.profile.arena import Arena, ProfileTable
from mc_nested.live.vision.layout import LayoutName, Scales

Dialect = Literal["1.12", "1.13", "1.17"]
"""The first version of each syntax of the commands (FACTS: Commands)."""

FORMAT: Literal[1] = 1
"""The format of a profile's file: it goes up by one when a key changes its meaning or is removed."""

Seconds = Annotated[float, Field(gt=0, le=60)]
Latency = Annotated[float, Field(ge=0, le=0.5)]
Fraction = Annotated[float, Field(ge=0, le=1)]
Shade = Annotated[int, Field(ge=0, le=255)]
Scale = Annotated[int, Field(ge=1, le=16)]
Key = Annotated[str, Field(min_length=1)]


def _whole(path: str) -> str:
    """Return an absolute path of any system, as a recording's profile may come from another one.

    Raise ValueError otherwise.

    ``~`` stands for the home folder.
    """
    if path.startswith("~") or PurePosixPath(path).is_absolute() or PureWindowsPath(path).is_absolute():
        return path
    raise ValueError(f"{path!r} depends on where you are: write the whole path, or one from ~")


WholePath = Annotated[str, AfterValidator(_whole)]


class WindowTable(ProfileTable):
    """Which window is the game's."""

    title: str = Field(
        default=GAME_TITLE,
        description="a regular expression that is found in the title of the game's window",
    )

    @field_validator("title")
    @classmethod
    def _is_an_expression(cls, title: str) -> str:
        try:
            re.compile(title)
        except re.error as error:
            raise ValueError(f"not a regular expression ({error}): mend it, or write a part of the title") from error
        return title


class GameVersion(ProfileTable):
    """Which Minecraft this is."""

    version: Annotated[str, Field(pattern=r"^\d+\.\d+(\D.*)?$")] = Field(
        default="1.21", description="the game's version, as its title screen says"
    )

    @field_validator("version")
    @classmethod
    def _is_minecrafts(cls, version: str) -> str:
        if not is_minecrafts(version):
            raise ValueError(f"Minecraft has no version {version!r}: write what its title screen says, such as 1.21.10")
        return version

    @property
    def dialect(self) -> Dialect:
        """The syntax of this version's commands; versions named by years (26.1) are newer than 1.21."""
        numbers = version_numbers(self.version)
        if numbers < (1, 13):
            return "1.12"
        return "1.13" if numbers < (1, 17) else "1.17"

    @property
    def takes_symbols(self) -> bool:
        """Whether it takes a key by what it makes, and not by its place (FACTS: Input and windows)."""
        return self.dialect == "1.12"


class KeysTable(ProfileTable):
    """Which key does what in this game, named by what a US keyboard has at its place: w, /, f3, left.shift."""

    forward: Key = Field(default="w", description="walks forward")
    back: Key = Field(default="s", description="walks backward")
    left: Key = Field(default="a", description="walks to the left")
    right: Key = Field(default="d", description="walks to the right")
    sneak: Key = Field(default="left.shift", description="slow steps")
    chat: Key = Field(default="t", description="opens the chat")
    debug: Key = Field(default="f3", description="turns the debug screen on")
    panic: Key = Field(
        default="f12", description="stops the agent at once, whichever window is in front; on a Mac usually with Fn"
    )
    takeover: Key = Field(
        default="f9", description="takes over from the agent, and gives back, whichever window is in front"
    )
    hotbar: Annotated[tuple[Key, ...], Field(min_length=9, max_length=9)] = Field(
        default=tuple("123456789"), description="the keys of the nine hotbar slots, from the left"
    )

    def pressed(self) -> list[str]:
        """Return the keys that are pressed into the game; the panic and the takeover key are the player's."""
        uses = (self.forward, self.back, self.left, self.right, self.sneak, self.chat, self.debug)
        return [*uses, *self.hotbar]

    @field_validator("*")
    @classmethod
    def _are_keys(cls, names: str | tuple[str, ...]) -> str | tuple[str, ...]:
        try:
            for name in (names,) if isinstance(names, str) else names:
                check_key(name)
        except ProfileError as error:
            raise ValueError(str(error)) from error
        return names

    @model_validator(mode="after")
    def _are_different(self) -> "KeysTable":
        uses = [(name, getattr(self, name)) for name in type(self).model_fields if name != "hotbar"]
        uses += [(f"hotbar slot {slot}", key) for slot, key in enumerate(self.hotbar, 1)]
        users: dict[str, str] = {}
        for use, key in uses:
            other = users.setdefault(canonical(key), use)
            if other != use:
                raise ValueError(f"{key!r} is given for {other} and for {use}: each needs a key of its own")
        return self


class ScreenTable(ProfileTable):
    """How the debug screen is drawn. Without a scale, all of it is found on the screen, for scales 1 to 8."""

    font: WholePath | None = Field(
        default=None,
        description="the game's own client jar, a resource pack or an ascii.png: a whole path, or one from ~",
    )
    debug_scale: Scale | None = Field(
        default=None, description="screen pixels to a dot of the font; left out, it is found on the screen"
    )
    layout: LayoutName | None = Field(
        default=None,
        description='which client draws the debug screen, "vanilla" or "stand-in"; counts beside debug_scale only, '
        "vanilla if left out",
    )
    line_pitch: Annotated[int, Field(ge=8, le=20)] | None = Field(
        default=None,
        description="dots from one line to the next; counts beside debug_scale only, the layout's if left out",
    )
    text_colour: tuple[Shade, Shade, Shade] | None = Field(
        default=None,
        description="red, green, blue of the text; counts beside debug_scale only, the layout's if left out",
    )

    def font_path(self) -> Path:
        """Return where the font is read from.

        Raise ProfileError if the profile names none, or a home that isn't here.
        """
        if self.font is None:
            raise ProfileError("screen.font is missing: write the path of your game's client jar into the profile")
        try:
            return Path(self.font).expanduser()
        except RuntimeError as error:
            raise ProfileError(f"screen.font: there is no such home folder here: {self.font}") from error


class WorldTable(ProfileTable):
    """A world without cheats: a reset leaves it, restores its folder from a copy, and enters it again by clicks."""

    folder: WholePath = Field(
        description="the world's folder in the game's saves; it must hold a file mc-nested-arena.txt"
    )
    template: WholePath = Field(
        description="a copy of that folder, elsewhere, with the agent on the start cell, looking the arena's way and "
        "body.pitch down, and the scenario's blocks in the hotbar"
    )
    name: str = Field(description="the world's name, as the list of worlds shows it")


class BlocksTable(ProfileTable):
    """How this game names blocks."""

    shown_prefix: str = Field(
        default="minecraft:",
        description="what the debug screen writes before a block's name",
    )
    names: dict[str, str] = Field(
        default_factory=dict, description="this game's name of a scenario's block, where it has another one"
    )


class InputTable(ProfileTable):
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


class BodyTable(ProfileTable):
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


class WalkTable(ProfileTable):
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
    input_latency_s: Latency = Field(
        default=INPUT_LATENCY_S,
        description="seconds from a press until the game has it, on average",
    )
    capture_latency_s: Latency = Field(
        default=CAPTURE_LATENCY_S,
        description="seconds from a tick until its step is on the screen, on average",
    )

    @field_validator("covered")
    @classmethod
    def _grows(cls, covered: tuple[float, ...]) -> tuple[float, ...]:
        if any(after <= before for before, after in zip((0.0, *covered), covered, strict=False)):
            raise ValueError("must grow with every tick: measure it again, or remove it to take the default")
        return covered


class CalibratedTable(ProfileTable):
    """What the profile was calibrated on, and when; written by calibration, checked before it is played with."""

    format: Literal[1] = Field(
        default=FORMAT, description="of this file: another version of mc-nested may know another one"
    )
    date: str = Field(description="the day, as year-month-day")
    version: str | None = Field(default=None, description="the version that the game's window said")
    window: tuple[int, int] | None = Field(default=None, description="the window's width and height in pixels")
    gui_scale: Scale | None = Field(
        default=None, description="screen pixels to a dot of the menus' and the chat's font, as seen"
    )
    debug_scale: Scale | None = Field(
        default=None, description="the same of the debug screen's font, as seen; left out, it is gui_scale"
    )
    samples: dict[str, int] = Field(
        default_factory=dict, description="how many measurements each step rests on, by its name"
    )

    @property
    def scales(self) -> Scales | None:
        """Both scales; None where they are not known."""
        return Scales(self.gui_scale, self.debug_scale or self.gui_scale) if self.gui_scale else None


class Profile(ProfileTable):
    """A user's calibrated facts, table by table as in the file."""

    window: WindowTable = WindowTable()
    game: GameVersion = GameVersion()
    keys: KeysTable = KeysTable()
    screen: ScreenTable = ScreenTable()
    arena: Arena | None = None
    world: WorldTable | None = None
    blocks: BlocksTable = BlocksTable()
    input: InputTable = InputTable()
    body: BodyTable = BodyTable()
    walk: WalkTable = WalkTable()
    points: dict[str, tuple[Fraction, Fraction]] = Field(
        default_factory=dict,
        description="places to click, as fractions of the window's size; their pictures lie beside this file",
    )
    calibrated: CalibratedTable | None = None

    def marked_arena(self) -> Arena:
        """Return the arena; raise ProfileError if none is marked yet."""
        if self.arena is None:
            raise ProfileError("the profile has no arena: stand where it should be and run mc-nested calibrate arena")
        return self.arena

    def block_name(self, block: str) -> str:
        """Return this game's name, without namespace, of a scenario's block (a name of Minecraft 1.13 and later)."""
        older = {"oak_planks": "planks"} if self.game.dialect == "1.12" else {}
        return self.blocks.names.get(block, older.get(block, block))

    def shown_id(self, block: str) -> str:
        """Return what the debug screen shows for a scenario's block."""
        return self.blocks.shown_prefix + self.block_name(block)
