from mc_nested.view.arena_panel import arena_panel
from mc_nested.view.status import ArenaSeen, Standing
from tests.arena.made_parts import STRIPES
from tests.view.shown import SMALL


def drawn(arena: ArenaSeen, trials: int = 1, width: int = 8, height: int = 4) -> list[str]:
    return [line.rstrip() for line in arena_panel(arena, trials, width, height).plain.split("\n")]


def test_arena_is_drawn_with_its_far_edge_on_top_and_one_sign_a_cell() -> None:
    assert drawn(SMALL) == [
        ". . . x",
        ". . o .",
        ". # o .",
        "^ . . .",
    ]


def test_beliefs_are_drawn_in_cells_where_nothing_stands() -> None:
    believing = SMALL.model_copy(update={"beliefs": ("....", "--?.", "o...", "....")})

    assert drawn(believing) == [
        ". . . x",
        "o . + .",
        "- # ? .",
        "^ . . .",
    ]


def test_all_trials_are_drawn_on_one_map() -> None:
    crowd = SMALL.model_copy(
        update={
            "stands": (Standing(1, 1, 10), Standing(2, 1, 60), Standing(3, 3, 90), Standing(2, 3, 30)),
            "agents": (Standing(0, 0, 81), Standing(1, 0, 9)),
        }
    )

    assert drawn(crowd, trials=90) == [
        ". . ▒x█x",
        ". . o .",
        ". ░░▓▓.",
        "* 9 . .",
    ]


def test_large_panel_has_large_cells_and_a_legend() -> None:
    lines = drawn(SMALL, width=40, height=12)

    assert lines[:4] == [".   .   .   x", "", ".   .   o   .", ""]
    assert lines[8] == "^ agent  # built  x off the design"


def test_cells_to_build_are_drawn_with_their_parts_number() -> None:
    stripes = ArenaSeen.of(STRIPES).model_copy(update={"stands": (Standing(1, 3, 1),)})
    lines = drawn(stripes, width=60, height=8)
    assert lines[:3] == [". . . . .", ". # 1 . .", ". 2 2 2 ."]
    assert "1 part 1  2 part 2" in lines[5]


def test_narrow_panel_has_one_column_a_cell() -> None:
    assert drawn(SMALL, width=4) == ["...x", "..o.", ".#o.", "^..."]


def test_a_panel_that_is_too_narrow_says_so() -> None:
    assert drawn(SMALL, width=3) == ["the arena needs 4 columns, there are 3"]


def test_the_legend_is_left_out_where_it_has_no_room() -> None:
    assert len(drawn(SMALL, width=40, height=5)) == 4


def test_right_and_wrong_blocks_differ_without_colours_too() -> None:
    text = arena_panel(SMALL, 1, 8, 4)
    styles = {text.plain[span.start]: str(span.style) for span in text.spans}

    assert styles["#"] != styles["x"]
    assert "#" in text.plain
    assert "x" in text.plain


def test_the_cell_that_is_built_next_has_a_sign_of_its_own_and_a_legend() -> None:
    lines = drawn(SMALL.model_copy(update={"objective": (2, 1)}), width=80, height=12)
    plain = drawn(SMALL, width=80, height=12)
    assert (lines[4].split(), plain[4].split()) == ([".", "#", "@", "."], [".", "#", "o", "."])
    assert ("@ next" in " ".join(lines), "@ next" in " ".join(plain)) == (True, False)
