r"""Takes names out of texts that others will read: home folders become ``~``, names of accounts ``<user>``.

Found in any spelling of a path (``/`` or ``\``, doubled where a text was quoted):

    /home/ann/.minecraft              ~/.minecraft, where that is the home folder
    C:\Users\Ann Lee\AppData          C:\Users\<user>\AppData: a home folder of anybody else
    saved by ann                      saved by <user>
"""

import contextlib
import getpass
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

HOME, USER = "~", "<user>"

GAME = "minecraft"
"""An account of this name identifies nobody, and the word is in every title, path and block."""

_VARIABLES = ("USER", "USERNAME", "LOGNAME", "SUDO_USER")
"""Environment variables that name the user."""

_ELSEWHERE = re.compile(
    # Names of Windows and macOS may hold spaces: such a name ends where the next part of its path begins.
    r"""(?P<windows>[\\/](?:Users|Documents[ ]and[ ]Settings)[\\/]+)(?:[^\\/\r\n"<>|:*?]+(?=[\\/])|[^\\/\s"'<>|:*?]+)"""
    r"""|(?P<unix>/home/+)[^\\/\s"'<>|:*?]+""",
    re.IGNORECASE,
)
_TITLES = re.compile(r"(windows on this desktop: ).*")
"""What an error lists of other programs' windows: their titles are a person's own."""

_LETTER = r"[^\W\d_]"
_END = r"""(?=$|[\\/\s"'`:;,)\]}>])"""
"""What may follow a folder's whole name."""


@dataclass(frozen=True)
class Names:
    """The names that identify a person: the home folder, as the system writes it, and the names of their account."""

    home: str
    users: tuple[str, ...]

    @cached_property
    def _home(self) -> re.Pattern[str] | None:
        parts = [re.escape(part) for part in re.split(r"[\\/]+", self.home) if part]
        if not parts:
            return None
        start = "" if parts[0].endswith(":") else r"[\\/]{1,2}"
        return re.compile(start + r"[\\/]+".join(parts) + _END, re.IGNORECASE)

    @cached_property
    def _users(self) -> re.Pattern[str]:
        # The longest first: otherwise a name that begins another one would leave the rest of it.
        names = sorted({re.escape(name) for name in self.users if len(name) > 1}, key=len, reverse=True)
        alone = "|".join(names) or r"(?!)"
        return re.compile(rf"{USER}|(?<!{_LETTER})(?:{alone})(?!{_LETTER})", re.IGNORECASE)

    def removed_from(self, text: str) -> str:
        """Return the text without them, and without the titles of other windows.

        Removing them twice is the same as removing them once.
        """
        text = _TITLES.sub(r"\1left out", text)
        if self._home is not None:
            text = self._home.sub(HOME, text)
        text = _ELSEWHERE.sub(lambda found: (found["windows"] or found["unix"]) + USER, text)
        return self._users.sub(USER, text)


def names_here(environment: Mapping[str, str] = os.environ) -> Names:
    """Return the names of the person who runs this."""
    home = Path.home()
    users = [environment[variable] for variable in _VARIABLES if environment.get(variable)]
    # A container's account may have no name.
    with contextlib.suppress(KeyError, OSError, ImportError):
        users.append(getpass.getuser())
    names = dict.fromkeys([*users, *([home.name] if home.name else [])])
    return Names(str(home), tuple(name for name in names if name.lower() != GAME))
