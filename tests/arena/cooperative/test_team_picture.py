"""A team's arena from above: every builder in a colour of its own, everything else as for one."""

import numpy as np

from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.cooperative.team_picture import BODIES, draw_team_picture, draw_team_text, rendered_team
from mc_nested.arena.picture import draw_picture
from mc_nested.arena.scenario_file import load_scenario

LINE = load_scenario("line")
TEAM = Team(LINE, ((7, 14), (3, 14)))


def test_builders_are_their_numbers_in_text() -> None:
    rows = draw_team_text(TEAM, [(7, 1), (0, 0)], {(7, 2), (5, 5)}).splitlines()
    assert rows[-1] == "1" + " ." * 14
    assert rows[-2].split()[7] == "0"
    assert rows[-3].split()[7] == "#"
    assert rows[-6].split()[5:8] == ["x", ".", "o"]


def test_one_builder_is_drawn_as_the_agent() -> None:
    ours = draw_team_picture(Team(LINE, (LINE.start,)), [(4, 4)], {(7, 2)})
    np.testing.assert_array_equal(ours, draw_picture(LINE, (4, 4), {(7, 2)}))


def test_each_builder_has_its_colour_in_its_cell() -> None:
    cells = [(0, 0), (14, 0), (0, 14), (14, 14)]
    picture = draw_team_picture(Team(LINE, tuple(cells)), cells, set(), cell_px=16)
    for (x, y), body in zip(cells, BODIES, strict=True):
        tile = picture[(14 - y) * 16 : (15 - y) * 16, x * 16 : (x + 1) * 16]
        assert (tile == body).all(axis=-1).any()
        assert not any((tile == other).all(axis=-1).any() for other in BODIES if other != body)


def test_a_render_mode_says_what_is_drawn() -> None:
    assert rendered_team(None, TEAM, TEAM.starts, ()) is None
    assert rendered_team("ansi", TEAM, TEAM.starts, ()) == draw_team_text(TEAM, TEAM.starts, ())
    assert rendered_team("rgb_array", TEAM, TEAM.starts, ()).shape == (240, 240, 3)
