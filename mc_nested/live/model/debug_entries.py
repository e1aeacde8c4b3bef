"""The entries of the debug screen, from 1.21.9 on, that are needed to play, and where they are switched on.

Each is known by its id, which is also its name on the debug options screen (FACTS: debug-profile.json).
"""

from mc_nested.live.model.reading import Reading
from mc_nested.live.model.versions import version_numbers

FIRST_WITH_ENTRIES = (1, 21, 9)
"""The first version whose debug screen is made of entries; before it, all that is needed is always shown."""

POSITION = "player_position"
TARGET, TARGET_FROM_26_1 = "looking_at_block", "looking_at_block_state"
"""The entry of the block that is looked at."""

DEFAULT_ENTRIES = (
    *("3d_crosshair", "fps", "game_version", "memory", POSITION, "player_section_position"),
    *("simple_performance_impactors", "system_specs", "tps"),
)
"""What the game shows where nobody has chosen: in every version so far, not the block looked at."""

PERFORMANCE_ENTRIES = ("gpu_utilization", "memory", "simple_performance_impactors", "tps")
"""What its profile "performance" shows besides ``fps``, which is always on in it."""

ASSUMED_DATA, DATA_OF_1_21_11 = 4649, 4671
"""Data versions: the one that a file is taken to have which names none, and that of 1.21.11."""

GROUND_PITCH_DEG = 30.0
"""At this pitch or more the player looks at the ground, at most some 3 blocks away, and a block is looked at."""

NONE_NAMED = "the debug screen names no block, though the ground is looked at"
LOOK_DOWN = "look down at the ground, and run this again"


def has_entries(version: str) -> bool:
    """Return whether the entries of this version's debug screen can be switched on and off."""
    return version_numbers(version) >= FIRST_WITH_ENTRIES


def target_entry(version: str) -> str:
    """Return the id of the entry for the block that is looked at."""
    return TARGET if version_numbers(version) < (26, 1) else TARGET_FROM_26_1


def on_button(version: str) -> str:
    """Return the button by which an entry is shown while the debug screen is on."""
    return "In F3" if version_numbers(version) < (1, 21, 11) else "In Overlay"


def switch_on(version: str | None) -> str:
    """Return how to switch that entry on in the game; None where the version isn't known."""
    if version is None:
        return f"from 1.21.9 on press F3+F6, and set {TARGET} (from 26.1 on {TARGET_FROM_26_1}) to In Overlay"
    return f"press F3+F6 in the game, and set {target_entry(version)} to {on_button(version)}"


def why_none_is_named(reading: Reading, version: str) -> str | None:
    """Return why a version whose entry may be off names no block, and what to do.

    Return None where the version names one, or its entry can't be off.

    Where the player looks up, an entry that is off and a view without a block look the same.
    """
    if reading.target is not None or reading.pitch is None or not has_entries(version):
        return None
    if reading.pitch < GROUND_PITCH_DEG:
        return f"no block is looked at, so whether the debug screen names it isn't known: {LOOK_DOWN}"
    return f"{NONE_NAMED}: {switch_on(version)}"


def have_block_named(version: str | None) -> str:
    """Return what to do where the ground is looked at and no block is named; None where the version isn't known."""
    return switch_on(version) if version is None or has_entries(version) else "stand on solid ground, out of the water"
