"""The question before an arena is built, and the summary afterwards."""

from collections.abc import Sequence

from calibration.arena.ground_survey import GroundSurvey
from calibration.arena.plan import box_at, copy_command
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.built_arena import FLOOR, border_block, box_of


def build_question(arena: Arena, ground: GroundSurvey, old: Arena | None, materials: Sequence[str]) -> str:
    """The question before anything is changed: what stands there, and what will be done."""
    low, high = arena.region
    stands = {True: "There is only air", False: "Something stands there", None: "What stands there is not known"}
    parts = [
        f"Build the arena from {low} to {high}, facing {arena.facing}? {stands[ground.is_free]}{_seen_in(ground)}."
    ]
    flat = {True: "is flat", False: "is not of one block", None: "may have holes, which is unknown here"}
    floor = "stays" if ground.keeps_floor else f"is replaced by {FLOOR}"
    parts.append(f"The floor, {ground.floor}, {flat[ground.is_flat]}: it {floor}.")
    parts.append(
        f"Every reset will remove all blocks of these two layers; around them comes a border of "
        f"{border_block(materials)}. Time, weather and mobs stand still, the game mode is creative, and the first "
        f"{len(materials)} slots of the hotbar are overwritten."
    )
    if ground.copy_to is not None:
        parts.append(f"What stands there is copied to {ground.copy_to} first, and --undo puts it back.")
    elif arena.copied_to is None:
        parts.append("No copy can be kept here: this can't be undone.")
    if old is not None and old.copied_to is not None and arena.copied_to is None:
        parts.append(f"The copy at {old.copied_to}, of what stood at the arena before this one, will be forgotten.")
    return " ".join(parts)


def undo_hint(arena: Arena) -> str:
    """The game's command that restores what stood there before."""
    if arena.copied_to is None:
        return "No copy was kept"
    box = box_of(arena)
    return f"What stood there comes back with {copy_command(box_at(box, arena.copied_to), box[0])}"


def build_summary(arena: Arena, ground: GroundSurvey, undo: str) -> list[str]:
    """What was built, one line each; ``undo`` is the command that puts back what stood there."""
    low, high = arena.region
    floor = f"the floor of {ground.floor} stayed" if ground.keeps_floor else f"the floor is {FLOOR}"
    lines = [f"Arena from {low} to {high}, facing {arena.facing}; {floor}, the border was seen on all four sides."]
    if arena.copied_to is not None:
        lines.append(f"What stood there is copied to {arena.copied_to}: {undo} puts it back.")
    else:
        lines.append("No copy was kept: this game can't copy blocks, or can't show that it did.")
    return lines


def _seen_in(ground: GroundSurvey) -> str:
    if ground.view is None:
        return ""
    blocks = [f"{name} at {block}" for block, name in list(ground.view.in_the_way.items())[:6]]
    looks = f"{ground.view.floor} of {ground.view.looks} looks saw the floor"
    far = [f"{ground.view.out_of_sight} more cells are out of sight"] if ground.view.out_of_sight else []
    return f" ({', '.join([*blocks, looks, *far])})"
