"""What the title of the game's window says: the version, and whether others may play in the world.

``Minecraft NeoForge* 1.20.4 - Singleplayer`` is the name, perhaps a loader's, a star for a modified game, the version,
and in a world its state, in the game's language (FACTS: Input and windows).
"""

import re

from mc_nested.live.model.versions import is_minecrafts

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
    """The release in the title of the game's window; None in a modpack's own title, and for a weekly snapshot.

    A number that is none of Minecraft's is a modpack's own.
    """
    found = _TITLE.fullmatch(title)
    release = _RELEASE.fullmatch(found["version"]) if found else None
    return release["release"] if release and is_minecrafts(release["release"]) else None


def state_in(title: str) -> str | None:
    """The state of the world that the title shows; None in menus, to 1.14, and in a modpack's own title."""
    found = _TITLE.fullmatch(title)
    state = _STATE.fullmatch(found["rest"]) if found else None
    return state["state"] if state else None


def may_be_shared(title: str) -> bool:
    """Whether the title says that others may play in this world, or says what can't be understood."""
    state = state_in(title)
    return _SHARED in title if state is None else state not in _ALONE
