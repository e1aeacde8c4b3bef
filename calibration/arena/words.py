"""What a person is asked and told about an arena that is built."""

from collections.abc import Sequence

from calibration.arena.ground import Ground
from calibration.arena.plan import FLOOR, border_block, box_of, copy_command, moved
from mc_nested.live.profile_tables import Arena


def question(arena: Arena, ground: Ground, old: Arena | None, materials: Sequence[str]) -> str:
    """What the player is asked before anything is touched: what stands there, and what will be done."""
    low, high = arena.region
    stands = {True: "There is only air", False: "Something stands there", None: "What stands there is not known"}
    parts = [
        f"Build the arena from {low} to {high}, facing {arena.facing}? {stands[ground.is_free]}{_seen_in(ground)}."
    ]
    flat = {True: "is flat", False: "is not of one block", None: "may have holes, that can't be told here"}
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


def how_to_undo(arena: Arena) -> str:
    """The command by which what stood there comes back."""
    if arena.copied_to is None:
        return "No copy was kept"
    box = box_of(arena)
    return f"What stood there comes back with {copy_command(moved(box, arena.copied_to), box[0])}"


def _seen_in(ground: Ground) -> str:
    if ground.sights is None:
        return ""
    found = [f"{name} at {block}" for block, name in list(ground.sights.in_the_way.items())[:6]]
    looks = f"{ground.sights.floor} of {ground.sights.looks} looks saw the floor"
    return f" ({', '.join([*found, looks])})"


def lines(arena: Arena, ground: Ground) -> list[str]:
    """What was built."""
    low, high = arena.region
    floor = f"the floor of {ground.floor} stayed" if ground.keeps_floor else f"the floor is {FLOOR}"
    lines = [f"Arena from {low} to {high}, facing {arena.facing}; {floor}, the border was seen on all four sides."]
    if arena.copied_to is not None:
        lines.append(f"What stood there is copied to {arena.copied_to}: mc-nested calibrate arena --undo puts it back.")
    else:
        lines.append("No copy was kept: this game can't copy blocks, or can't show that it did.")
    return lines
