import pytest

from mc_nested.live.model.reading import Target
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen, TextLine
from tests.sim.client.f3_lines import left_lines, right_lines

TARGET = Target((17, -63, -33), "minecraft:oak_log")


def screen(layout: Layout, **more: object) -> F3Screen:
    given = {"target": TARGET, "properties": (("axis", "y"), ("lit", "true")), "tags": ("minecraft:logs",), **more}
    return F3Screen(layout, 2, (-17.25, 70.5, 513.75), 91.04, -3.5, **given)  # type: ignore[arg-type]  # mixed fields


def left(layout: Layout, **more: object) -> list[str]:
    return [line.text for line in left_lines(screen(layout, **more))]


def right(layout: Layout, **more: object) -> list[str]:
    return [line.text for line in right_lines(screen(layout, **more))]


@pytest.mark.parametrize(
    ("layout", "lines"),
    [
        ("1.8-1.12", ["Block: -18 70 513", "Chunk: 14 6 1 in -2 4 32", "Biome: Plains", "Looking at: 17 -63 -33"]),
        ("1.13-1.15", ["Block: -18 70 513", "Biome: minecraft:plains", "Looking at block: 17 -63 -33"]),
        ("1.16-1.19.2", ["Block: -18 70 513", "Chunk: 14 6 1 in -2 4 32"]),
        ("1.19.3-1.21.8", ["Block: -18 70 513 [14 6 1]", "Chunk: -2 4 32 [30 0 in r.-1.1.mca]"]),
    ],
)
def test_the_left_column_has_the_lines_of_its_layout(layout: Layout, lines: list[str]) -> None:
    shown = left(layout)
    assert [line for line in shown if line in lines] == lines
    assert "XYZ: -17.250 / 70.50000 / 513.750" in shown
    assert "Facing: west (Towards negative X) (91.0 / -3.5)" in shown


@pytest.mark.parametrize("layout", ["1.16-1.19.2", "1.19.3-1.21.8"])
def test_the_left_column_names_no_target_since_1_16(layout: Layout) -> None:
    assert not [line for line in left(layout) if line.startswith("Looking")]


@pytest.mark.parametrize(
    ("layout", "heading"),
    [
        ("1.13-1.15", ["Targeted Block"]),
        ("1.16-1.19.2", ["Targeted Block: 17, -63, -33"]),
        ("1.8-1.12", []),
    ],
)
def test_the_right_column_describes_the_target(layout: Layout, heading: list[str]) -> None:
    about = [*heading, "minecraft:oak_log", "axis: y", "lit: true", "#minecraft:logs", ""]
    assert right(layout)[-len(about) :] == about
    underlined = [line.text for line in right_lines(screen(layout)) if line.underlined]
    assert underlined == heading


def test_true_and_false_have_their_own_colours() -> None:
    lines = right_lines(screen("1.16-1.19.2", properties=(("axis", "y"), ("lit", "true"), ("wet", "false"))))
    assert [line for line in lines if ": " in line.text][-3:] == [
        TextLine("axis: y"),
        TextLine("lit: true", "true"),
        TextLine("wet: false", "false"),
    ]


def test_no_column_names_a_target_if_there_is_none() -> None:
    for layout in ("1.8-1.12", "1.13-1.15", "1.16-1.19.2", "standin"):
        shown = left(layout, target=None) + right(layout, target=None)
        assert not [line for line in shown if "ook" in line or "oak_log" in line or "Targeted" in line]


def test_a_target_without_a_position_is_shown_by_its_name_only() -> None:
    named = Target(None, "minecraft:oak_log")
    assert "Targeted Block" in right("1.16-1.19.2", target=named)
    for layout in ("1.8-1.12", "1.13-1.15", "standin"):
        assert not [line for line in left(layout, target=named) + right(layout, target=named) if "Looking" in line]


@pytest.mark.parametrize(
    ("layout", "lines"),
    [
        ("1.8-1.12", []),
        ("1.13-1.15", ["Targeted Fluid", "minecraft:water", "level: 8", "#minecraft:water"]),
        ("1.16-1.19.2", ["Targeted Fluid: 3, 62, -9", "minecraft:water", "level: 8", "#minecraft:water"]),
    ],
)
def test_a_fluid_follows_the_target(layout: Layout, lines: list[str]) -> None:
    shown = right(layout, fluid=(3, 62, -9))
    assert [line for line in shown if "luid" in line or "water" in line or "level" in line] == lines
    liquid = "Looking at liquid: 3 62 -9" in left(layout, fluid=(3, 62, -9))
    assert liquid == (layout == "1.13-1.15")


def test_reduced_debug_info_shows_only_the_position_in_the_chunk() -> None:
    shown = left("1.19.3-1.21.8", reduced=True)
    assert shown[-2:] == ["", "Chunk-relative: 14 6 1"]
    assert not [line for line in shown + right("1.19.3-1.21.8", reduced=True) if "XYZ" in line or "Targeted" in line]


def test_the_stand_in_writes_its_own_lines() -> None:
    shown = left("standin")
    assert shown[4] == "XYZ: -17.250 / 70.500 / 513.750"
    assert shown[5] == "Chunk: 14 ~ 1 in -2 ~ 32"
    assert shown[7] == "Facing (minecraft): west (towards negative X) (91.0 -3.5)"
    assert right("standin")[2:] == ["minecraft:oak_log", "axis: y", "lit: true", "Looking at: 17 -63 -33"]


@pytest.mark.parametrize(
    ("yaw", "facing"),
    [(-180.0, "north"), (-46.0, "east"), (-44.0, "south"), (44.0, "south"), (46.0, "west"), (136.0, "north")],
)
def test_the_facing_is_the_nearest_of_four(yaw: float, facing: str) -> None:
    lines = left_lines(F3Screen("1.16-1.19.2", 1, (0.0, 64.0, 0.0), yaw, 0.0))
    assert [line.text.split()[1] for line in lines if line.text.startswith("Facing")] == [facing]


def test_the_first_line_names_the_version_or_else_one_of_its_layout() -> None:
    assert left("1.16-1.19.2", version="1.17.1")[0] == "Minecraft 1.17.1 (1.17.1/vanilla)"
    assert left("1.16-1.19.2")[0] == "Minecraft 1.16.4 (1.16.4/vanilla)"
