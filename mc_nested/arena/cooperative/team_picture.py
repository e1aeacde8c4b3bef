"""A team's arena from above, the far edge on top, as text and as a picture: each builder in a colour of its own."""

from collections.abc import Collection, Sequence
from typing import Any

from mc_nested.arena.action import Cell
from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.drawing import kind_of
from mc_nested.arena.picture import AGENT_BODY, CELL_PX, Colour, Picture, draw_agent, draw_picture

BODIES: tuple[Colour, ...] = (AGENT_BODY, (34, 122, 74), (122, 66, 160), (24, 118, 150))
"""The builders' colours, by number: red, green, violet, blue."""


def draw_team_text(team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> str:
    """The arena as a line of text a row, two characters a cell; a builder is its number."""
    across = range(team.scenario.size)
    number_at = {cell: str(number) for number, cell in enumerate(cells)}
    rows = (
        " ".join(number_at.get((x, y)) or kind_of(team.scenario, None, placed, (x, y)) for x in across)
        for y in reversed(across)
    )
    return "\n".join(rows)


def draw_team_picture(team: Team, cells: Sequence[Cell], placed: Collection[Cell], cell_px: int = CELL_PX) -> Picture:
    """The arena as ``draw_picture`` draws it, (size * cell_px, size * cell_px, 3), with every builder."""
    picture = draw_picture(team.scenario, None, placed, cell_px)
    for cell, body in zip(cells, BODIES, strict=False):
        draw_agent(picture, team.scenario.size, cell, cell_px, body)
    return picture


def rendered_team(mode: str | None, team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> Any:
    """The arena from above as a render mode wants it; None without one."""
    if mode == "rgb_array":
        return draw_team_picture(team, cells, placed)
    if mode == "ansi":
        return draw_team_text(team, cells, placed)
    return None
