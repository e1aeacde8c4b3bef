"""Scenario files: the shipped ones are the task's table, a user's own is read whole or refused in one line."""

import itertools
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import LARGEST_SIZE, SMALLEST_SIZE, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.scenario import DEFAULT_SIZE, Material, Part, Scenario
from mc_nested.arena.scenario_file import (
    draw_grid,
    load_scenario,
    paper_scenarios,
    parse_scenario,
    scenario_of,
    shipped_scenarios,
    table_of,
)
from mc_nested.errors import ScenarioError
from tests.arena.made_parts import scenarios_with_parts

WOOD, STONE = Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")

DESIGNS = {
    "line": {(7, y) for y in range(2, 13)},
    "zigzag": set(zip([7, 8, 9, 8, 7, 6, 5, 6, 7, 8, 9], range(2, 13), strict=True)),
    "diamond": {(x, y) for x in range(15) for y in range(15) if abs(x - 7) + abs(y - 7) == 4},
}

OWN = f"""
name = "dot"
start = [3, 4]
step_limit = 9
design = '''
{draw_grid(frozenset({(2, 5)}), DEFAULT_SIZE)}'''
[[materials]]
name = "glass"
p = 1
block = "glass"
"""


@pytest.mark.parametrize(("name", "optimum"), [("line", 21), ("zigzag", 21), ("diamond", 26)])
def test_the_papers_scenarios_match_the_tasks_table(name: str, optimum: float) -> None:
    scenario = load_scenario(name)
    assert scenario.design == DESIGNS[name]
    assert scenario.start == (7, 14)
    assert scenario.step_limit == 60
    assert scenario.materials == (WOOD, STONE)
    assert scenario.optimum == optimum
    assert scenario.best_material == 1
    assert scenario.start_state == (7, 14, len(DESIGNS[name]))


def test_a_users_file_is_read_by_its_path(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN)
    scenario = load_scenario(tmp_path / "dot.toml")
    assert scenario == Scenario("dot", frozenset({(2, 5)}), (3, 4), 9, (Material("glass", 1.0, "glass"),))


def test_a_file_that_begins_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN, encoding="utf-8-sig")
    assert load_scenario(tmp_path / "dot.toml").name == "dot"


def test_seven_scenarios_are_shipped_and_three_are_the_papers() -> None:
    assert paper_scenarios() == ["line", "zigzag", "diamond"]
    assert shipped_scenarios() == ["line", "zigzag", "diamond", "islands", "house", "square", "flag"]


@pytest.mark.parametrize(("name", "blocks"), [("islands", 6), ("house", 40), ("square", 100), ("flag", 16)])
def test_other_shipped_scenarios_allow_at_least_1_45_times_the_builders_steps(name: str, blocks: int) -> None:
    scenario = load_scenario(name)
    assert (scenario.blocks, scenario.size, scenario.start) == (blocks, 15, (7, 14))
    assert scenario.materials == (WOOD, STONE)
    assert scenario.step_limit >= 1.45 * len(build(scenario))


def test_the_square_is_filled_and_the_islands_are_two() -> None:
    assert load_scenario("square").design == {(x, y) for x in range(3, 13) for y in range(2, 12)}
    islands = sorted(load_scenario("islands").design)
    assert [max(abs(x - i), abs(y - j)) <= 1 for (x, y), (i, j) in itertools.pairwise(islands)] == (
        [True, True, False, True, True]
    )


@given(st.integers(SMALLEST_SIZE, LARGEST_SIZE), st.lists(st.floats(-100, 100), min_size=1, max_size=9), st.data())
def test_a_scenario_is_read_back_from_its_table_unchanged(size: int, worth: list[float], data: st.DataObject) -> None:
    materials = tuple(Material(f"m{index}", p, "stone") for index, p in enumerate(worth))
    buildable = st.tuples(st.integers(0, size - 1), st.integers(1, size - 1))
    start = data.draw(st.tuples(st.integers(0, size - 1), st.integers(0, size - 1)))
    scenario = Scenario("any", data.draw(st.frozensets(buildable, min_size=1)), start, size * size, materials, size)
    assert scenario_of(table_of(scenario), "here") == scenario


def check_refused(text: str, says: str) -> None:
    """Raise AssertionError unless that scenario file is refused in one line with its name and ``says``."""
    with pytest.raises(ScenarioError) as caught:
        parse_scenario(text, "dot.toml")
    assert str(caught.value).startswith("dot.toml: ")
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


def drawn(rows: list[str], start: str = "[3, 4]") -> str:
    """Return a scenario file with that drawing."""
    head = OWN.replace("start = [3, 4]", f"start = {start}").partition("design")[0]
    lines = "".join(row + "\n" for row in rows)
    return f"{head}design = '''\n{lines}'''\n" + '[[materials]]\nname = "glass"\np = 1\nblock = "glass"\n'


@pytest.mark.parametrize("size", [5, 14, 20, 32])
def test_the_drawings_size_sets_the_arenas_size(size: int) -> None:
    rows = ["." * (size - 1) + "#", *["." * size] * (size - 2), "." * size]
    scenario = parse_scenario(drawn(rows, f"[0, {size - 1}]"), "dot.toml")
    assert scenario.size == size
    assert scenario.design == {(size - 1, size - 1)}
    assert scenario.start == (0, size - 1)


@pytest.mark.parametrize(
    ("rows", "start", "says"),
    [
        (["...#"] + ["...."] * 3, "[0, 0]", "design: 4 x 4 cells: an arena has 5 to 32 a side"),
        (["#" + "." * 32] + ["." * 33] * 32, "[0, 0]", "design: 33 x 33 cells: an arena has 5 to 32 a side"),
        (["#...."] + ["....."] * 5, "[0, 0]", "6 rows, and row 1 has 5 characters: draw a square"),
        (["#....", "....", ".....", ".....", "....."], "[0, 0]", "5 rows, and row 2 has 4 characters: draw a square"),
        ([], "[0, 0]", "design: 0 x 0 cells"),
        (["#...."] + ["....."] * 4, "[5, 4]", "start: (5, 4) lies outside: choose 0 to 4 for x and y"),
        (["#" + "." * 19] + ["." * 20] * 19, "[0, 20]", "start: (0, 20) lies outside: choose 0 to 19 for x and y"),
        (["#" + "." * 19] + ["." * 20] * 19, "[-1, 0]", "start: (-1, 0) lies outside: choose 0 to 19 for x and y"),
    ],
)
def test_an_invalid_drawing_or_start_is_refused_in_one_line(rows: list[str], start: str, says: str) -> None:
    check_refused(drawn(rows, start), says)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("step_limit = 9", "step_limit = 0"), "step_limit"),
        (("step_limit = 9", "steps = 9"), "step_limit"),
        (("step_limit = 9", f"step_limit = {10**30}"), "step_limit"),
        (('name = "dot"', 'name = "dot\\nted"'), "name"),
        (("p = 1", "p = inf"), "materials.0.p"),
        (("p = 1", "p = nan"), "materials.0.p"),
        (("p = 1", "p = 1e300"), "materials.0.p"),
        (("start = [3, 4]", "start = [15, 4]"), "lies outside: choose 0 to 14"),
        (("start = [3, 4]", "start = [3]"), "start"),
        (('name = "dot"', 'name = "dot"\ncolour = "red"'), "colour"),
        (('name = "dot"', "name = dot"), "not TOML"),
        (("#", "."), "has no block"),
        (("#", "?"), "design: row 10 is '..?............': write '#' for a block and '.' for none"),
        (("..#............", "..#..........."), "15 rows, and row 10 has 14 characters: draw a square"),
        (("p = 1", 'p = "much"'), "materials.0.p"),
        (('block = "glass"', 'block = "Glass Pane"'), "materials.0.block"),
        (("[[materials]]", '[[materials]]\nname="glass"\np=2\nblock="glass"\n[[materials]]'), "same name"),
    ],
)
def test_a_mistake_in_a_scenario_file_is_refused_in_one_line_that_names_the_mistake(
    change: tuple[str, str], says: str
) -> None:
    check_refused(OWN.replace(*change), says)


def test_a_cell_on_the_near_edge_is_refused_as_unreachable() -> None:
    near = OWN.replace(draw_grid(frozenset({(2, 5)}), 15), draw_grid(frozenset({(2, 5), (4, 0)}), 15))
    with pytest.raises(ScenarioError, match=r"cell \(4, 0\) can't be reached.*keep the bottom row free"):
        parse_scenario(near, "dot.toml")


def test_cells_out_of_reach_may_be_drawn_where_some_are_in_reach_and_that_is_asked_for() -> None:
    near = draw_grid(frozenset({(2, 5), (4, 0)}), 15)
    drawn = OWN.replace(draw_grid(frozenset({(2, 5)}), 15), near)
    assert parse_scenario(drawn, "dot.toml", must_reach=False).design == {(2, 5), (4, 0)}
    one_step = drawn.replace("step_limit = 9", "step_limit = 1")
    assert parse_scenario(one_step, "dot.toml", must_reach=False).step_limit == 1
    with pytest.raises(ScenarioError, match=r"cell \(4, 0\) can't be reached"):
        parse_scenario(drawn.replace(near, draw_grid(frozenset({(4, 0)}), 15)), "dot.toml", must_reach=False)


def test_too_few_steps_for_the_blocks_are_refused() -> None:
    tight = OWN.replace("step_limit = 9", "step_limit = 1").replace("..#............", "..##...........")
    with pytest.raises(ScenarioError, match="1 steps can't place 2 blocks: raise it"):
        parse_scenario(tight, "dot.toml")


def test_an_unknown_scenario_name_is_refused_with_the_known_ones() -> None:
    with pytest.raises(ScenarioError, match="no scenario 'pyramid': name one of line, zigzag, diamond, islands"):
        load_scenario("pyramid")


def test_a_path_without_its_ending_is_refused_with_a_suggestion(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(OWN)
    with pytest.raises(ScenarioError, match=r"did you mean .*dot\.toml\?$"):
        load_scenario(tmp_path / "dot")


def test_an_unknown_material_is_refused_with_the_known_ones() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold': choose one of wood, stone"):
        load_scenario("line").material_index("gold")


def in_parts(*drawings: frozenset[Cell], more: str = "") -> str:
    """Return a scenario file in an arena of 5, whose parts are drawn like that."""
    design = draw_grid(frozenset({(1, 3), (2, 3), (1, 2)}), 5)
    head = f'name = "two"\nstart = [0, 0]\nstep_limit = 20\n{more}\n'
    materials = (
        f'[[materials]]\nname = "{name}"\np = {p}\nblock = "{name}"\n' for name, p in (("glass", 1), ("ice", 2))
    )
    parts = (f"[[parts]]\ncells = '''\n{draw_grid(cells, 5)}'''\nworth = {{ ice = 0 }}\n" for cells in drawings)
    return f"{head}design = '''\n{design}'''\n" + "".join((*materials, *parts))


FAR, NEAR = frozenset({(1, 3), (2, 3)}), frozenset({(1, 2)})


def test_parts_are_read_in_order_and_materials_they_do_not_name_are_worth_their_p() -> None:
    scenario = parse_scenario(in_parts(FAR, NEAR, more="choose_every = 4"), "two.toml")
    assert scenario.parts == (Part(FAR, (1.0, 0.0)), Part(NEAR, (1.0, 0.0)))
    assert scenario.choose_every == 4
    assert parse_scenario(in_parts(FAR, NEAR), "two.toml").choose_every is None


def test_a_table_without_regions_does_not_name_them_so_that_checkpoints_from_before_still_fit() -> None:
    table = table_of(load_scenario("flag"))
    assert "regions" not in table.model_dump()
    assert table.model_copy(update={"regions": True}).model_dump()["regions"] is True


@given(scenarios_with_parts())
def test_a_scenario_with_parts_is_read_back_from_its_table_unchanged(scenario: Scenario) -> None:
    assert scenario_of(table_of(scenario), "here") == scenario


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (in_parts(FAR, FAR | NEAR), "parts: cell (1, 3) is in part 2 and in an earlier one: draw it in one"),
        (in_parts(FAR), "parts: cell (1, 2) of the design is in no part: draw it in one"),
        (in_parts(NEAR, FAR), "parts: what is built first shuts off a cell of a later part"),
        (in_parts(FAR, NEAR).replace("ice = 0", "gold = 0", 1), "parts: part 1: there is no material 'gold'"),
        (in_parts(FAR, NEAR).replace("ice = 0", "ice = nan", 1), "parts.0.worth.ice"),
        (in_parts(FAR, NEAR, more="choose_every = 0"), "choose_every"),
        (in_parts(more="choose_every = 4"), "choose_every: goes with [[parts]]"),
        (in_parts(more="regions = true"), "regions: goes with [[parts]]"),
        (in_parts(FAR) + "[[parts]]\ncells = '''#'''", "parts: part 2: 1 rows, and the design has 5: draw as many"),
        (in_parts(FAR, NEAR).replace("cells = '''\n.....", "cells = '''\n..?..", 1), "parts: part 1: row 1 is '..?..'"),
    ],
)
def test_a_mistake_in_the_parts_is_refused_in_one_line_that_names_the_mistake(text: str, says: str) -> None:
    check_refused(text, says)
