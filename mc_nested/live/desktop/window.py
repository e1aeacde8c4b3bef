"""The game's window as the operating system describes it, and which of all windows it is."""

import re
from collections.abc import Sequence
from typing import Protocol

from mc_nested.errors import DesktopError, NoWindowError, SeveralWindowsError
from mc_nested.live.devices import DesktopArea

SHOWN_TITLES = 8
"""Titles that an error names at most: enough to find a misspelling, and still one line."""


class GameWindow(Protocol):
    """One window of the desktop. It may move, change its title, and close at any time."""

    def title(self) -> str: ...

    def client_area(self) -> DesktopArea:
        """Where the client area is now; DesktopError where the window has closed or is minimised."""

    def is_in_front(self) -> bool:
        """Whether a key pressed now would reach this window."""


def matching_title(title: str, titles: Sequence[str]) -> int:
    """The index of the one title in which the regular expression ``title`` is found.

    NoWindowError where there is none, SeveralWindowsError where there are several.
    """
    found = [index for index, each in enumerate(titles) if re.search(title, each)]
    if len(found) == 1:
        return found[0]
    if not found:
        known = _listed([each for each in titles if each]) or "none"
        raise NoWindowError(
            f"no window's title matches {title!r}: start the game, or set window.title in the profile; "
            f"windows on this desktop: {known}"
        )
    raise SeveralWindowsError(
        f"{len(found)} windows' titles match {title!r}: {_listed([titles[index] for index in found])}: "
        "close all but the game's, or set window.title in the profile"
    )


def is_within(area: DesktopArea, outer: DesktopArea) -> bool:
    """Whether all of an area lies in another one."""
    return (
        outer.left <= area.left
        and outer.top <= area.top
        and area.left + area.width <= outer.left + outer.width
        and area.top + area.height <= outer.top + outer.height
    )


def check_shown(area: DesktopArea, title: str) -> None:
    """DesktopError where the client area is empty, as a minimised window's is."""
    if area.width < 1 or area.height < 1:
        raise minimised_error(title)


def minimised_error(title: str) -> DesktopError:
    """The error for a window that isn't shown."""
    return DesktopError(f"the window {title!r} is minimised or hidden: bring it back onto the screen")


def closed_error(title: str) -> DesktopError:
    """The error for a window that no longer exists."""
    return DesktopError(f"the window {title!r} has closed: start the game again")


def _listed(titles: Sequence[str]) -> str:
    shown = sorted(set(titles))
    more = f" and {len(shown) - SHOWN_TITLES} more" if len(shown) > SHOWN_TITLES else ""
    return ", ".join(repr(each) for each in shown[:SHOWN_TITLES]) + more
