"""The debug options (F3+F6, from 1.21.9 on): each entry of the debug screen with three buttons (FACTS: Debug options).

Positions and sizes are in GUI pixels; ``width`` and ``height`` are the window's.
"""

from itertools import groupby

from sim.client.game.debug_entries import DebugEntries, Status, known_entries
from sim.client.game.edition import Edition
from sim.client.game.widgets import GREY, WHITE, Colour, Effect, EntryChange, Menu, MenuPanel, MenuText, Widget

_HEADER, _FOOTER, _ROW = 61, 33, 20
_BUTTON_HEIGHT, _LINE = 16, 2
_WARNING = (
    "These options are for testing purposes only. They may",
    "slow down your computer, crash the game, or eat your pet rock.",
)
_REDDISH: Colour = (223, 80, 80)
_UNCHOSEN: Colour = (186, 186, 186)
_COLOURS: dict[Status, Colour] = {"never": WHITE, "inOverlay": (255, 255, 85), "alwaysOn": _REDDISH}

_RENDERED = frozenset({"3d_crosshair", "chunk_borders", "entity_hitboxes"})
_RENDERED_FROM = ("chunk_section_octree", "chunk_section_paths", "chunk_section_visibility", "visualize_")

Choice = tuple[str, Status]
"""An entry, and when it is shown."""


def choices(entries: DebugEntries, edition: Edition, searched: str) -> tuple[Choice, ...]:
    """Return the entries whose ids contain the searched text, as they are listed: first texts, then others, by id."""
    found = (entry for entry in known_entries(edition) if searched in entry)
    return tuple(
        (entry, entries.get(entry, "never")) for entry in sorted(found, key=lambda entry: (_is_3d(entry), entry))
    )


def debug_options(shown: tuple[Choice, ...], searched: str, edition: Edition, width: int, height: int) -> Menu:
    """Return the screen with those choices. What the list has no room for is left out, until it is searched for."""
    wide, button = (350, 60) if edition.since(1, 21, 11) else (310, 44)
    left, right = width // 2 - wide // 2 + 2, width // 2 + wide // 2 - 2
    labels: dict[Status, str] = {
        "never": "OFF",
        "inOverlay": "In Overlay" if edition.since(1, 21, 11) else "In F3",
        "alwaysOn": "Always",
    }
    texts, buttons = [], []
    top = _HEADER + 2
    for is_3d, group in groupby(shown, key=lambda choice: _is_3d(choice[0])):
        texts.append(MenuText("Renderer" if is_3d else "Debug Screen Text", width // 2, top + 7))
        top += _ROW
        for entry, status in group:
            if top + _ROW > height - _FOOTER:
                break
            texts.append(MenuText(entry, left, top + 7, is_centred=False))
            for place, (each, label) in enumerate(labels.items()):
                at, does = right - (3 - place) * button, EntryChange(entry, each)
                colour, is_open = (_UNCHOSEN, True) if each != status else (_COLOURS[each], False)
                buttons.append(Widget(label, at, top + 2, button, does, _BUTTON_HEIGHT, is_open, colour=colour))
            top += _ROW
        if top + _ROW > height - _FOOTER:
            break
    panels = (
        MenuPanel(0, _HEADER, width, height - _HEADER - _FOOTER, 128),
        MenuPanel(0, _HEADER - _LINE, width, _LINE),
        MenuPanel(0, height - _FOOTER, width, _LINE),
        MenuPanel(width // 2 + 48, 7, wide // 3, _ROW),
    )
    header = (
        MenuText("Debug Options", width // 2, 12),
        MenuText(searched or "Search for options", width // 2 + 52, 13, WHITE if searched else GREY, is_centred=False),
        *(MenuText(line, width // 2, 35 + 9 * row, _REDDISH) for row, line in enumerate(_WARNING)),
    )
    return Menu((*header, *texts), (*buttons, *_footer(edition, width, height)), panels)


def _footer(edition: Edition, width: int, height: int) -> tuple[Widget, ...]:
    row: list[tuple[str, int, Effect]] = [
        ("Default profile", 120, "default_profile"),
        ("Performance profile", 120, "performance_profile"),
        ("Done", 60, "resume"),
    ]
    gap = 8
    if edition.since(26, 3):
        row.insert(2, ("Debug GUI Scale", 110, ""))
        gap = 4
    at, footer = width // 2 - (sum(wide + gap for _, wide, _ in row) - gap) // 2, []
    for label, wide, does in row:
        footer.append(Widget(label, at, height - _FOOTER + 6, wide, does))
        at += wide + gap
    return tuple(footer)


def _is_3d(entry: str) -> bool:
    """Return whether an entry is drawn in the world, and no text."""
    return entry in _RENDERED or entry.startswith(_RENDERED_FROM)
