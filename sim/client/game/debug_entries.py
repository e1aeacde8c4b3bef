"""The entries that the debug screen shows from 1.21.9 on, and debug-profile.json, which lists them.

FACTS: The F3 debug screen. An entry's id stands here without its namespace, ``minecraft:``.
"""

import json
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Literal, get_args

from mc_nested.errors import UserError
from mc_nested.live.model.debug_entries import (
    ASSUMED_DATA,
    DATA_OF_1_21_11,
    DEFAULT_ENTRIES,
    PERFORMANCE_ENTRIES,
    TARGET,
    TARGET_FROM_26_1,
)
from sim.client.game.edition import Edition

Status = Literal["alwaysOn", "inOverlay", "never"]
"""An entry's line is there always, with F3 alone, or never."""

DebugEntries = Mapping[str, Status]
"""Entries by id; one that isn't named is never shown."""


def _with_f3(*ids: str) -> DebugEntries:
    return MappingProxyType(dict.fromkeys(ids, "inOverlay"))


GAME_DEFAULT = _with_f3(*DEFAULT_ENTRIES)
"""The game's own choice, in every version so far: the block looked at is not shown."""

PERFORMANCE: DebugEntries = MappingProxyType({**_with_f3(*PERFORMANCE_ENTRIES), "fps": "alwaysOn"})
"""The game's other profile, which has no position."""

TUTORIAL: DebugEntries = MappingProxyType({**GAME_DEFAULT, **_with_f3(TARGET, TARGET_FROM_26_1)})
"""What our tutorial asks for: the default, and the block looked at, under the name that the version has for it."""

_PROFILES = {"default": GAME_DEFAULT, "performance": PERFORMANCE}

_OLD_NAMES = {TARGET: TARGET_FROM_26_1, "looking_at_fluid": "looking_at_fluid_state"}
"""Ids to 1.21.11, and from 26.1 on: a file of an older game is upgraded when it is read."""

_NAMING = frozenset({TARGET, TARGET_FROM_26_1})

_FIRST_IN_OVERLAY = 4650
"""The DataVersion from which on a file says ``inOverlay``, not ``inF3``."""

_FIRST_SPLIT = DATA_OF_1_21_11 + 1
"""The DataVersion from which on a file has the new ids, or one between."""

_FREELY = frozenset(
    {
        *("chunk_render_stats", "chunk_source_stats", "entity_render_stats", "fps", "game_version", "gpu_utilization"),
        *("memory", "particle_render_stats", "player_section_position", "simple_performance_impactors", "sound_mood"),
        *("system_specs", "tps"),
    }
)
"""The entries that reduced debug info shows, too."""

_ENTRIES: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    **dict.fromkeys(
        (
            *("3d_crosshair", "biome", "chunk_borders", "chunk_generation_stats", "chunk_render_stats"),
            *("chunk_section_octree", "chunk_section_paths", "chunk_section_visibility", "chunk_source_stats"),
            *("entity_hitboxes", "entity_render_stats", "entity_spawn_counts", "fps", "game_version"),
            *("gpu_utilization", "heightmap", "light_levels", "local_difficulty", "looking_at_entity", "memory"),
            *("particle_render_stats", "player_position", "player_section_position", "simple_performance_impactors"),
            *("sound_mood", "system_specs", "tps", "visualize_block_light_levels", "visualize_chunks_on_server"),
            *("visualize_collision_boxes", "visualize_entity_supporting_blocks", "visualize_heightmap"),
            *("visualize_sky_light_levels", "visualize_sky_light_sections", "visualize_solid_faces"),
            "visualize_water_levels",
        ),
        ((1, 21, 9), ()),
    ),
    **dict.fromkeys(("looking_at_block", "looking_at_fluid"), ((1, 21, 9), (26, 1))),
    "post_effect": ((1, 21, 9), (26, 3)),
    **dict.fromkeys(
        (
            *("day_count", "detailed_memory", "looking_at_block_state", "looking_at_block_tags"),
            *("looking_at_entity_tags", "looking_at_fluid_state", "looking_at_fluid_tags", "sound_cache"),
        ),
        ((26, 1), ()),
    ),
    **dict.fromkeys(("player_speed", "post_effects"), ((26, 3), ())),
    **dict.fromkeys(("chunk_load_status", "chunk_section_status", "lightmap_texture"), ((26, 4), ())),
}
"""Each entry's first version, and the first that doesn't have it any more, if there is one."""

_ID = re.compile(r"(?:[a-z0-9_.-]*:)?[a-z0-9_./-]+")


def known_entries(edition: Edition) -> tuple[str, ...]:
    """Return the ids of all entries that a version has, in their order; none before 1.21.9."""
    return tuple(entry for entry in sorted(_ENTRIES) if _has(edition, entry))


def shown_entries(
    entries: DebugEntries, edition: Edition, *, has_f3: bool, is_reduced: bool = False
) -> tuple[str, ...]:
    """Return the ids of the entries on the screen, in their order; what the version doesn't know is ignored."""
    shown = ("alwaysOn", "inOverlay") if has_f3 else ("alwaysOn",)
    return tuple(
        entry
        for entry in sorted(entries)
        if entries[entry] in shown and _has(edition, entry) and (entry in _FREELY or not is_reduced)
    )


def read_profile(text: str, edition: Edition) -> DebugEntries:
    """Return the entries that a debug-profile.json stands for: ``custom`` replaces everything.

    UserError if the game can't read it, and would replace it.
    """
    try:
        profile = json.loads(text)
        custom, written = profile.get("custom", {}), profile.get("DataVersion")
        written = written if isinstance(written, int | float) else ASSUMED_DATA
        entries = {_name(name, written, edition): _status(each, written, edition) for name, each in custom.items()}
        return _PROFILES[profile["profile"]] if "profile" in profile else entries
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        problem = "it is no JSON" if isinstance(error, json.JSONDecodeError) else "an entry or a value is unknown there"
        raise UserError(
            f"no debug-profile.json of Minecraft {edition.version}, {problem}: the game would replace it by its "
            "default entries"
        ) from error


def names_block(entries: DebugEntries, edition: Edition) -> bool:
    """Return whether the debug screen names the block looked at while it is on."""
    return bool(_NAMING.intersection(shown_entries(entries, edition, has_f3=True)))


def _has(edition: Edition, entry: str) -> bool:
    since, until = _ENTRIES.get(entry, ((), ()))
    return bool(since) and edition.since(*since) and not (until and edition.since(*until))


def _name(entry: str, written: float, edition: Edition) -> str:
    if not _ID.fullmatch(entry):
        raise ValueError(entry)
    # Another namespace, a mod's, stays in the name, which then is no entry's of the game.
    name = entry.removeprefix("minecraft:")
    return _OLD_NAMES.get(name, name) if edition.since(26, 1) and written < _FIRST_SPLIT else name


def _status(status: Any, written: float, edition: Edition) -> Status:
    overlay = "inOverlay" if edition.since(1, 21, 11) else "inF3"
    if edition.since(1, 21, 11) and status == "inF3" and written < _FIRST_IN_OVERLAY:
        status = overlay
    allowed: dict[Any, Status] = {name: name for name in get_args(Status)}
    allowed[overlay] = "inOverlay"
    if overlay == "inF3":
        del allowed["inOverlay"]
    return allowed[status]
