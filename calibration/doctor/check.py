"""A check of the doctor's, one row of its table: what was checked, its status, what was found, and what to do."""

from dataclasses import dataclass
from enum import Enum
from typing import Literal

Status = Literal["pass", "warn", "fail", "skip"]
"""In this order: good; works, but not always; keeps the agent from playing; can't be known now."""

FIX = "close the game and run mc-nested doctor --fix"
"""What to do about a file of the game's that the doctor can mend."""


class CheckName(str, Enum):
    """Every check, in the order of the table; the value is the name that the table and the JSON show."""

    SESSION = "session"
    DISPLAY_SCALING = "display scaling"
    PROFILE = "profile"
    PROFILE_FITS = "profile fits"
    FONT = "font"
    WINDOW = "game's window"
    IN_FRONT = "in front"
    SIZE_AND_SCALE = "size and GUI scale"
    DEBUG_SCREEN = "debug screen"
    REDUCED_DEBUG_INFO = "reduced debug info"
    POSITION_LINE = "position line"
    TARGET_LINE = "looked-at line"
    DEBUG_ENTRIES = "debug entries"
    OPTIONS = "options.txt"
    PAUSE_ON_LOST_FOCUS = "pauseOnLostFocus"
    AUTO_JUMP = "autoJump"
    GUI_SCALE = "guiScale"
    DEBUG_GUI_SCALE = "debugGuiScale"
    FORCE_UNICODE_FONT = "forceUnicodeFont"
    FULLSCREEN = "fullscreen"
    TOGGLE_CROUCH = "toggleCrouch"
    TOGGLE_ATTACK = "toggleAttack"
    TOGGLE_USE = "toggleUse"
    CHAT_VISIBILITY = "chatVisibility"
    SAVE_CHAT_DRAFTS = "saveChatDrafts"
    TEXT_BACKGROUND = "textBackgroundOpacity"
    FRIENDS_KEY = "friends key"
    LANGUAGE = "language"
    KEYS = "keys"
    CLIPBOARD = "clipboard"
    INPUT = "input"

    def __str__(self) -> str:
        """Return the name as shown."""
        return self.value


@dataclass(frozen=True)
class Check:
    """A row of the table; ``fix`` is empty if nothing has to be done."""

    name: CheckName
    status: Status
    detail: str
    fix: str = ""


def check_from_message(name: CheckName, status: Status, message: str) -> Check:
    """Return the check of an error or a problem, whose message is what is wrong, a colon, and what to do."""
    detail, _, fix = message.partition(": ")
    return Check(name, status, detail, fix)
