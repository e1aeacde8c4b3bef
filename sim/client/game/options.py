"""The lines of the game's options.txt that change how it looks or acts here (FACTS: options.txt)."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

from mc_nested.errors import UserError
from sim.client.game.edition import Edition

LARGEST_SCALE = 100
"""No window is so large that a GUI scale above this fits."""

SHOWN, COMMANDS, HIDDEN = range(3)
"""What ``chat_visibility`` may be."""

HALF = 128
"""The alpha of a background that is half black, out of 255."""


@dataclass(frozen=True)
class GameOptions:
    """The options in options.txt; the defaults are the game's own, in every version.

    ``gui_scale`` 0 is Auto. ``debug_gui_scale`` (26.3 on) is 0 for Auto, -1 for the GUI scale.
    ``text_background_opacity`` is 0 to 1; it counts for what is typed only without ``background_for_chat_only``.
    ``chat_visibility`` is 0 for shown, 1 for the answers of commands alone, 2 for hidden.
    """

    gui_scale: int = 0
    debug_gui_scale: int = 0
    pause_on_lost_focus: bool = True
    reduced_debug_info: bool = False
    chat_visibility: int = 0
    text_background_opacity: float = 0.5
    background_for_chat_only: bool = True
    save_chat_drafts: bool = False
    toggle_crouch: bool = False
    toggle_attack: bool = False
    toggle_use: bool = False

    @property
    def toggled(self) -> frozenset[str]:
        """The actions whose keys are pressed once to begin, and once more to end."""
        actions = {"sneak": self.toggle_crouch, "attack": self.toggle_attack, "use": self.toggle_use}
        return frozenset(action for action, is_toggled in actions.items() if is_toggled)

    @property
    def message_ground(self) -> int:
        """The alpha, out of 255, of the black behind messages in full (FACTS: The chat's line)."""
        return round(255 * self.text_background_opacity)

    @property
    def typed_ground(self) -> int:
        """The alpha, out of 255, of the black behind the line being typed."""
        return HALF if self.background_for_chat_only else self.message_ground


class _Line(NamedTuple):
    """An option: its field, how a value is read (KeyError or ValueError if it can't be), its values, since when."""

    field: str
    read: Callable[[str], Any]
    values: str
    since: tuple[int, ...] = (1, 12)


def _switch(field: str, *since: int) -> _Line:
    return _Line(field, lambda value: {"true": True, "false": False}[value], "true or false", since or (1, 12))


def _number(field: str, least: int, most: int, *since: int) -> _Line:
    numbers = {str(number): number for number in range(least, most + 1)}
    return _Line(field, numbers.__getitem__, f"a whole number, {least} to {most}", since or (1, 12))


def _part(value: str) -> float:
    part = float(value)
    if not 0.0 <= part <= 1.0:
        raise ValueError
    return part


LINES = {
    "guiScale": _number("gui_scale", 0, LARGEST_SCALE),
    "debugGuiScale": _number("debug_gui_scale", -1, LARGEST_SCALE, 26, 3),
    "pauseOnLostFocus": _switch("pause_on_lost_focus"),
    "reducedDebugInfo": _switch("reduced_debug_info"),
    "chatVisibility": _number("chat_visibility", 0, 2),
    "textBackgroundOpacity": _Line("text_background_opacity", _part, "a number, 0 to 1", (1, 14)),
    "backgroundForChatOnly": _switch("background_for_chat_only", 1, 14),
    "saveChatDrafts": _switch("save_chat_drafts", 1, 21, 9),
    "toggleCrouch": _switch("toggle_crouch", 1, 15),
    "toggleAttack": _switch("toggle_attack", 1, 21, 9),
    "toggleUse": _switch("toggle_use", 1, 21, 9),
}
"""What is known of each line, by the option's name in the file."""


def parse_options(lines: Iterable[str], edition: Edition) -> GameOptions:
    """Return the options of these lines, each ``NAME:VALUE``; of two for one name the last counts (FACTS: options.txt).

    UserError for a name that isn't known, or not in this version, and for a value that the option can't have.
    """
    values: dict[str, Any] = {}
    for line in lines:
        name, _, value = line.partition(":")
        known = LINES.get(name)
        if known is None:
            raise UserError(f"no option {name!r} is known: name one of {', '.join(LINES)}")
        if not edition.since(*known.since):
            first = ".".join(map(str, known.since))
            raise UserError(f"Minecraft {edition.version} has no option {name}: it came with {first}")
        try:
            values[known.field] = known.read(value)
        except (KeyError, ValueError):
            raise UserError(f"{name} can't be {value!r}: give {known.values}") from None
    return GameOptions(**values)
