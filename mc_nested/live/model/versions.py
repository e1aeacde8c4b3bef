"""Minecraft's versions by their numbers, and what the title of the game's window says: the version, and who may play.

To 1.21.11, then by years, 26.1 and on (FACTS: Versions). ``Minecraft NeoForge* 1.20.4 - Singleplayer`` is the name,
perhaps a loader's, a star for a modified game, the version, and in a world its state, in the game's language
(FACTS: Input and windows).
"""

import re

NEWEST = (26, 4)
"""The newest version whose screens and commands are known here."""

_NUMBERS = re.compile(r"(\d+)\.(\d+)(?:\.(\d+))?")

_FIRST_YEAR, _MOST_A_YEAR = 26, 9
"""The first year that versions are named by, and how many of them one may have: it was never more than half of that."""

_LAST_PATCHES = (1, 0, 5, 2, 7, 2, 4, 10, 9, 4, 2, 2, 2, 2, 4, 2, 5, 1, 2, 4, 6, 11)
"""The last patch of 1.0, 1.1 and so on to 1.21."""


def version_numbers(version: str) -> tuple[int, int, int]:
    """Return three numbers that order versions, as (1, 21, 0) of ``1.21`` and (26, 4, 0) of ``26.4-snapshot-1``.

    Zeros where the text doesn't begin like a version.
    """
    found = _NUMBERS.match(version)
    return (int(found[1]), int(found[2]), int(found[3] or 0)) if found else (0, 0, 0)


def is_minecrafts(version: str) -> bool:
    """Return whether Minecraft has, or may come to have, a version of these numbers: no 1.22, no 25.1, no 26.0."""
    first, second, patch = version_numbers(version)
    if first == 1:
        return second < len(_LAST_PATCHES) and patch <= _LAST_PATCHES[second]
    return first >= _FIRST_YEAR and 1 <= second <= _MOST_A_YEAR and patch <= max(_LAST_PATCHES)


def draws_text_over_menus(version: str) -> bool:
    """Return whether the debug screen lies over menus, chat and toasts (FACTS: The F3 debug screen)."""
    return version_numbers(version) >= (1, 21, 9)


def later_version_line(version: str) -> str | None:
    """Return one line about a version that is later than all known ones: how it is played, what to look at.

    Return None for any other version.
    """
    if version_numbers(version)[:2] <= NEWEST:
        return None
    newest = ".".join(map(str, NEWEST))
    return (
        f"Minecraft {version} is later than {newest}, the newest that is known here, and is played as that: look in "
        "the calibration's report whether screen, menus and commands are as expected (mc-nested calibrate report)"
    )


GAME_TITLE = r"^Minecraft(?: \w+)?\*? \d"
"""A regular expression for the title of the game's window where no pack has replaced it."""

_TITLE = re.compile(r"Minecraft(?: \w+)?\*? (?P<version>\d\S*)(?P<rest>.*)")
_RELEASE = re.compile(r"(?P<release>\d+\.\d+(?:\.\d+)?)(?:-.+)?")
_STATE = re.compile(r" - (?P<state>.+)")

_ALONE = frozenset(
    {
        *("Singleplayer", "Einzelspieler", "Solo", "Un jugador", "Um jogador", "Giocatore singolo", "Alleen spelen"),
        *("Enspelarläge", "Enkeltspiller", "Yksinpeli", "Tryb jednoosobowy", "Hra jednoho hráče", "Egyjátékos mód"),
        *("Tek Oyunculu", "Одиночная игра", "Гра наодинці", "单人游戏", "單人遊戲", "シングルプレイ", "싱글플레이"),
    }
)
"""The state of a world that nobody else can join: ``title.singleplayer`` of the game's language files of 1.17, for
English, German, French, Spanish, Portuguese, Italian, Dutch, Swedish, Danish (as English), Norwegian, Finnish, Polish,
Czech, Hungarian, Turkish, Russian, Ukrainian, Chinese, Japanese and Korean."""

_SHARED = "Multiplayer"


def version_in(title: str) -> str | None:
    """Return the release in the title of the game's window; None in a modpack's own title, and for a weekly snapshot.

    A number that is none of Minecraft's is a modpack's own.
    """
    found = _TITLE.fullmatch(title)
    release = _RELEASE.fullmatch(found["version"]) if found else None
    return release["release"] if release and is_minecrafts(release["release"]) else None


def state_in(title: str) -> str | None:
    """Return the state of the world that the title shows; None in menus, to 1.14, and in a modpack's own title."""
    found = _TITLE.fullmatch(title)
    state = _STATE.fullmatch(found["rest"]) if found else None
    return state["state"] if state else None


def may_be_shared(title: str) -> bool:
    """Return whether the title says that others may play in this world, or says what can't be understood."""
    state = state_in(title)
    return _SHARED in title if state is None else state not in _ALONE
