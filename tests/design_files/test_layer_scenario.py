"""A scenario from a layer: where its blocks lie, what is cut off, and that the scripted builder builds every one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import draw_grid, load_scenario, scenario_of, table_of
from mc_nested.design_files.layer_scenario import scenario_of_layer
from mc_nested.design_files.volume import Volume
from mc_nested.errors import ScenarioError
from tests.arena.simulated import arena_env

LINE = load_scenario("line")


def layer(*rows: str) -> Volume:
    """Return one layer, the northern row first; a letter is a kind of block."""
    palette = ("air", *sorted({character for row in rows for character in row} - {"."}))
    numbers = [[0 if character == "." else palette.index(character) for character in row] for row in rows]
    return Volume(palette, np.array([numbers], np.int32))


def drawn(scenario: Scenario) -> list[str]:
    return draw_grid(scenario.design, scenario.size).split()


def full(width: int, length: int) -> Volume:
    return layer(*["s" * width] * length)


def test_north_becomes_the_far_edge_east_the_right_and_the_blocks_are_centred() -> None:
    scenario, notes = scenario_of_layer("hook", layer("......", "...ss.", "...s.."), 0)
    assert drawn(scenario) == ["." * 15] * 6 + ["......##.......", "......#........"] + ["." * 15] * 7
    assert notes == []


def test_the_scenario_of_a_layer_has_the_shipped_designs_materials_start_and_step_limit() -> None:
    scenario, _ = scenario_of_layer("bar", full(4, 1), 0)
    assert (scenario.name, scenario.materials, scenario.step_limit) == ("bar", LINE.materials, 60)
    assert (scenario.size, scenario.start) == (15, LINE.start)


@pytest.mark.parametrize(
    ("width", "length", "size", "start"),
    [(15, 14, 15, (7, 14)), (15, 15, 16, (8, 15)), (16, 1, 16, (8, 15)), (32, 31, 32, (16, 31)), (1, 20, 21, (10, 20))],
)
def test_the_arena_is_as_large_as_the_blocks_need_with_the_near_edge_free(
    width: int, length: int, size: int, start: tuple[int, int]
) -> None:
    scenario, notes = scenario_of_layer("block", full(width, length), 0)
    assert (scenario.size, scenario.start, scenario.blocks) == (size, start, width * length)
    assert min(y for _, y in scenario.design) >= 1
    assert notes == []


def test_the_middle_of_a_larger_layer_is_kept_and_the_cut_is_reported() -> None:
    scenario, notes = scenario_of_layer("field", full(40, 35), 0)
    assert (scenario.size, scenario.blocks) == (32, 32 * 31)
    assert len(notes) == 1
    assert notes[0] == (
        "40 x 35 cells have blocks, and an arena has room for 32 x 31: only the middle is kept; 408 of 1400 blocks, "
        "around it, are cut off"
    )


def test_a_larger_layer_keeps_exactly_its_middle_columns() -> None:
    row = "".join("s" if column in (0, 3, 4, 35, 36, 40) else "." for column in range(41))
    scenario, notes = scenario_of_layer("dots", layer(row), 0)
    assert sorted(x for x, _ in scenario.design) == [0, 31]  # columns 4 to 35
    assert "4 of 6 blocks" in notes[0]


def test_a_layer_without_a_block_in_its_middle_is_refused() -> None:
    ring = ["s" * 40, *["s" + "." * 38 + "s"] * 38, "s" * 40]
    with pytest.raises(ScenarioError, match="layer 0 has no block in its middle 32 x 31 cells"):
        scenario_of_layer("ring", layer(*ring), 0)


def test_kinds_of_blocks_are_reported_most_frequent_first() -> None:
    _, notes = scenario_of_layer("mixed", layer("aabbbcde"), 0)
    assert notes == ["its blocks are built of one material: 3 b, 2 a, 1 c, 2 others"]


@pytest.mark.parametrize(
    ("name", "layers", "becomes"),
    [
        ("house", 3, "house-2"),
        ("house", 1, "house"),
        ("a\nb\x1b[1m\udc80", 1, "ab[1m"),
        ("x" * 99, 3, "x" * 58 + "-2"),
        ("\n", 1, "design"),
    ],
)
def test_the_name_of_a_scenario_is_changed_to_one_that_a_run_can_store(name: str, layers: int, becomes: str) -> None:
    volume = Volume(("air", "stone"), np.ones((layers, 1, 1), np.int32))
    scenario, _ = scenario_of_layer(name, volume, layers - 1)
    assert scenario.name == becomes
    assert scenario_of(table_of(scenario), "here") == scenario


SHAPES = {
    "ring around the agent": ["s" * 15, *["s" + "." * 13 + "s"] * 12, "s" * 15],
    "spiral": ["sssssss", "......s", "sssss.s", "s...s.s", "s.sss.s", "s.....s", "sssssss"],
    "comb": ["s.s.s.s.s"] * 9 + ["sssssssss"],
    "comb upside down": ["sssssssss"] + ["s.s.s.s.s"] * 9,
    "chessboard": ["s." * 7, ".s" * 7] * 7,
    "full": ["s" * 15] * 14,
    "full and large": ["s" * 32] * 31,
    "nested rooms": ["sssssssss", "s.......s", "s.sssss.s", "s.s...s.s", "s.sssss.s", "s.......s", "sssssssss"],
    "four corners": ["s" + "." * 30 + "s", *["." * 32] * 29, "s" + "." * 30 + "s"],
}


@pytest.mark.parametrize("shape", SHAPES)
def test_shapes_in_which_a_builder_could_lock_itself_in_are_built_within_the_step_limit(shape: str) -> None:
    scenario, _ = scenario_of_layer(shape, layer(*SHAPES[shape]), 0)
    assert scenario.blocks == sum(row.count("s") for row in SHAPES[shape])
    check_built(scenario)


@given(st.integers(1, 40), st.integers(1, 40), st.data())
def test_any_layer_is_built_within_the_step_limit(width: int, length: int, data: st.DataObject) -> None:
    filled = data.draw(st.lists(st.booleans(), min_size=width * length, max_size=width * length).filter(any))
    volume = Volume(("air", "stone"), np.array(filled, np.int32).reshape(1, length, width))
    try:
        scenario, _ = scenario_of_layer("any", volume, 0)
    except ScenarioError as error:
        assert "has no block in its middle" in str(error)  # noqa: PT017 - no other error may be raised
        return
    check_built(scenario)


def check_built(scenario: Scenario) -> None:
    """Check that the scripted builder's actions build the whole design in the Env, and so end the episode."""
    env = arena_env(scenario)
    env.reset()
    *_, (_, _, terminated, truncated, info) = [env.step(action) for action in build(scenario)]
    assert terminated
    assert not truncated
    assert info["score"] == scenario.optimum
    assert env.placed == scenario.design
