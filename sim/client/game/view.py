"""The content of the game's picture at one moment, before anything is drawn."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from mc_nested.live.model.reading import Block
from sim.client.game.chat import ChatLine, TypedLine
from sim.client.game.f3_screen import F3Screen
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState


@dataclass(frozen=True)
class Eye:
    """The camera: its position in blocks, its view in degrees."""

    position: tuple[float, float, float]
    yaw: float
    pitch: float


@dataclass(frozen=True)
class Sight:
    """The world as the player sees it.

    ``built`` are the blocks that differ from the bare floor, whose top is at the height ``floor``: the same mapping as
    long as nothing changes. ``target`` is the block that is looked at, within reach; ``held`` the block in the hand.
    """

    eye: Eye
    built: Mapping[Block, str]
    floor: int
    floor_block: str
    target: Block | None = None
    held: str | None = None


class View(NamedTuple):
    """One moment. ``f3`` is None while the debug screen is off, ``typed`` while the chat is closed.

    ``scene`` is the block that the player is in: the world behind shifts with it. ``pointer`` is the mouse in GUI
    pixels where a menu is open. ``notices`` are the texts at the upper right from the top down, empty in a free place.
    ``sight`` is None where the world isn't drawn as it is, but a random picture in its place.
    """

    menu: MenuState
    scene: Block
    f3: F3Screen | None = None
    hotbar: tuple[Stack | None, ...] = ()
    slot: int = 0
    chat: tuple[ChatLine, ...] = ()
    typed: TypedLine | None = None
    is_creative: bool = True
    pointer: tuple[int, int] = (-1, -1)
    notices: tuple[str, ...] = ()
    sight: Sight | None = None
