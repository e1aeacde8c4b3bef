"""What calls hold, as plain values of JSON, and back."""

from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

from mc_nested.live.devices import Region
from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.vision.menu_labels import MenuButton


def plain(value: Any) -> Any:
    """Regions, readings and buttons as their fields, tuples as lists; everything else must be plain already."""
    if isinstance(value, Region):
        return [value.left, value.top, value.width, value.height]
    if is_dataclass(value) and not isinstance(value, type):
        return {name: plain(part) for name, part in asdict(value).items() if part is not None}
    if isinstance(value, Mapping):
        return {name: plain(part) for name, part in value.items()}
    if isinstance(value, tuple | list):
        return [plain(part) for part in value]
    return value


def reading_of(value: Mapping[str, Any]) -> Reading:
    """A reading from its fields; KeyError, TypeError or ValueError where they are others."""
    xyz = value.get("xyz")
    target = value.get("target")
    return Reading(
        None if xyz is None else _xyz(xyz),
        value.get("yaw"),
        value.get("pitch"),
        None if target is None else _target(target),
        value.get("problem"),
    )


def position_of(value: Any) -> tuple[float, float, float] | None:
    """A position in the world, or None."""
    return None if value is None else _xyz(value)


def button_of(value: Mapping[str, Any]) -> MenuButton:
    """A button from its fields."""
    middle = value.get("middle")
    return MenuButton(
        None if middle is None else (int(middle[0]), int(middle[1])),
        bool(value.get("is_enabled", False)),
        value.get("problem"),
        int(value.get("scale", 1)),
    )


def region_of(value: list[int] | None) -> Region | None:
    """A region from its four numbers."""
    return None if value is None else Region(*value)


def _xyz(value: Any) -> tuple[float, float, float]:
    x, y, z = value
    return float(x), float(y), float(z)


def _target(value: Mapping[str, Any]) -> Target:
    pos = value.get("pos")
    if pos is None:
        return Target(None, value.get("id"))
    x, y, z = pos
    return Target((int(x), int(y), int(z)), value.get("id"))
