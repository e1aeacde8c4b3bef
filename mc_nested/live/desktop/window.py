"""The game's window as the operating system describes it, and which of all windows it is."""

import re
from collections.abc import Sequence
from typing import NamedTuple, Protocol

from mc_nested.errors import DesktopError, NoWindowError, SeveralWindowsError
from mc_nested.live.devices import DesktopArea
from mc_nested.live.model.versions import GAME_TITLE

SHOWN_TITLES = 8
"""Titles that an error names at most: enough to find a misspelling, and still one line."""

_OTHERS = re.compile(
    r"firefox|mozilla|librewolf|waterfox|floorp|chrom|brave|msedge|microsoft.edge|vivaldi|safari|iexplore|epiphany"
    r"|konqueror|falkon|browser|\bopera\b|launcher|multimc|modrinth|curseforge",
    re.IGNORECASE,
)
"""Classes and processes of browsers and launchers, whose pages may have the game's title (FACTS: Input and windows)."""

_LOADING = re.compile(r"Minecraft: \w+ Loading")
"""The title of NeoForge's and Forge's first window, before the game's own (FACTS: Input and windows)."""

_OWN_TITLE = "write a part of that into the profile, such as title = 'Lunar Client' under [window]"


class GameWindow(Protocol):
    """One window of the desktop. It may move, change its title, and close at any time."""

    def title(self) -> str: ...

    def client_area(self) -> DesktopArea:
        """Return where the client area is now; raise DesktopError where the window has closed or is minimised."""

    def is_in_front(self) -> bool:
        """Return whether a key pressed now would reach this window."""


class TitledWindow(NamedTuple):
    """A window of the desktop by its title; ``program`` is what its class or its process is called, if known."""

    title: str
    program: str = ""


def game_window(title: str, windows: Sequence[TitledWindow]) -> int:
    """Return the index of the one window in whose title the regular expression ``title`` is found.

    A browser's and a launcher's windows are none of the game's, unless the title is one of the player's own choice.
    Raise NoWindowError where there is none, SeveralWindowsError where there are several.
    """
    found = [index for index, each in enumerate(windows) if re.search(title, each.title)]
    if title == GAME_TITLE:
        found = [index for index in found if not _OTHERS.search(windows[index].program)]
    if len(found) == 1:
        return found[0]
    if not found:
        known = _listed([_described(each) for each in windows if each.title]) or "none"
        if any(_LOADING.match(each.title) for each in windows):
            raise NoWindowError(
                f"the game is still loading: wait for its title screen; windows on this desktop: {known}"
            )
        what = "no window of the game is open" if title == GAME_TITLE else f"no window's title matches {title!r}"
        raise NoWindowError(
            f"{what}: start the game, or, where it has another title, {_OWN_TITLE}; windows on this desktop: {known}"
        )
    raise SeveralWindowsError(
        f"{len(found)} windows' titles match {title!r}: {_listed([repr(windows[index].title) for index in found])}: "
        f"close all but the game's, or {_OWN_TITLE}"
    )


def is_within(area: DesktopArea, outer: DesktopArea) -> bool:
    """Return whether all of an area lies in another one."""
    return (
        outer.left <= area.left
        and outer.top <= area.top
        and area.left + area.width <= outer.left + outer.width
        and area.top + area.height <= outer.top + outer.height
    )


def check_shown(area: DesktopArea, title: str) -> None:
    """Raise DesktopError where the client area is empty, as a minimised window's is."""
    if area.width < 1 or area.height < 1:
        raise minimised_error(title)


def minimised_error(title: str) -> DesktopError:
    """Return the error for a window that isn't shown."""
    return DesktopError(f"the window {title!r} is minimised or hidden: bring it back onto the screen")


def closed_error(title: str) -> DesktopError:
    """Return the error for a window that no longer exists."""
    return DesktopError(f"the window {title!r} has closed: start the game again")


def _described(window: TitledWindow) -> str:
    is_passed_over = re.search(GAME_TITLE, window.title) and _OTHERS.search(window.program)
    return repr(window.title) + (f" (of {window.program})" if is_passed_over else "")


def _listed(titles: Sequence[str]) -> str:
    shown = sorted(set(titles))
    more = f" and {len(shown) - SHOWN_TITLES} more" if len(shown) > SHOWN_TITLES else ""
    return ", ".join(shown[:SHOWN_TITLES]) + more
