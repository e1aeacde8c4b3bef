"""The Minecraft version of a virtual client, and what it changes in titles, screens and commands."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from mc_nested.live.model.versions import version_numbers

Layout = Literal["1.8-1.12", "1.13-1.15", "1.16-1.19.2", "1.19.3-1.21.8", "1.21.9-26.3", "standin", "26.4"]
"""How a debug screen is laid out: by the versions that have it, or the stand-in's."""

_LAYOUTS: tuple[tuple[tuple[int, ...], Layout], ...] = (
    ((26, 4), "26.4"),
    ((1, 21, 9), "1.21.9-26.3"),
    ((1, 19, 3), "1.19.3-1.21.8"),
    ((1, 16), "1.16-1.19.2"),
    ((1, 13), "1.13-1.15"),
    ((1, 8), "1.8-1.12"),
)


@dataclass(frozen=True)
class Edition:
    """A version by its name, such as 1.12.2, 1.20.1 or 26.1; years come after 1.21 (FACTS: Commands)."""

    version: str

    @cached_property
    def _numbers(self) -> tuple[int, int, int]:
        return version_numbers(self.version)

    def since(self, *numbers: int) -> bool:
        """Return whether this version is at least as new as that one."""
        return self._numbers >= numbers

    @cached_property
    def layout(self) -> Layout:
        """The layout of its debug screen (FACTS: The F3 debug screen)."""
        return next(layout for first, layout in _LAYOUTS if self.since(*first))

    def title(self, *, in_world: bool, state: str = "Singleplayer") -> str:
        """Return the window's title; from 1.15 on, in a world, with its state after it (FACTS: Input and windows).

        The state is in the game's language.
        """
        name = f"Minecraft {self.version}"
        return f"{name} - {state}" if in_world and self.since(1, 15) else name

    def sneaking_height(self) -> tuple[float, float]:
        """Return the sneaking player's height and that of their eyes, in blocks (FACTS: Sneaking)."""
        return (1.5, 1.27) if self.since(1, 14) else (1.65, 1.54)

    def shown_id(self, block: str) -> str:
        """Return a block's id as the debug screen shows it."""
        return f"minecraft:{block}"
