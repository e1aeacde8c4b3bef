"""Corpus files: many designs a person drew, centred; every mistake is one line that names file and design."""

from pathlib import Path

import pytest

from mc_nested.arena.design import load_corpus, parse_corpus
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import ScenarioError

LINE = load_scenario("line")


def corpus(*designs: tuple[str, str]) -> str:
    return "".join(f'[[designs]]\nname = "{name}"\ndesign = """\n{drawing}\n"""\n' for name, drawing in designs)


def test_designs_come_in_their_order_and_small_ones_are_centred(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("# of mine\n" + corpus(("dot", "#"), ("hook", "#..\n###"), ("even", "##")), "utf-8")
    dot, hook, even = load_corpus(path, LINE)
    assert dot.design == {(7, 7)}
    assert hook.design == {(6, 7), (7, 7), (8, 7), (6, 8)}
    assert even.design == {(6, 7), (7, 7)}
    assert [each.name for each in (dot, hook, even)] == ["dot", "hook", "even"]
    assert all(
        (each.start, each.materials, each.step_limit) == (LINE.start, LINE.materials, 60) for each in (dot, hook)
    )


def test_a_drawing_as_large_as_the_arena_keeps_its_position() -> None:
    rows = ["#" + "." * 14, *["." * 15] * 12, "." * 14 + "#", "." * 15]
    (scenario,) = parse_corpus(corpus(("corners", "\n".join(rows))), "mine", LINE)
    assert scenario.design == {(0, 14), (14, 1)}


def test_a_drawing_of_fourteen_rows_keeps_the_near_edge_free() -> None:
    (scenario,) = parse_corpus(corpus(("tall", "\n".join(["#"] * 14))), "mine", LINE)
    assert scenario.design == {(7, y) for y in range(1, 15)}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (corpus(("a", "#"), ("b", "##\n#")), "mine: design 'b': not a design: write rows of equal length"),
        (corpus(("a", "#o#")), "mine: design 'a': not a design"),
        (corpus(("a", "")), "mine: design 'a': not a design"),
        (corpus(("a", "...\n...")), r"mine: design 'a': has no block \('#'\): draw at least one"),
        (corpus(("a", "#" * 16)), "mine: design 'a': 16 x 1 cells are more than the arena's 15 x 15: draw it smaller"),
        (corpus(("a", "\n".join("#" * 16))), "mine: design 'a': 1 x 16 cells are more"),
        (corpus(("a", "\n".join("#" * 15))), "mine: design 'a': its bottom row can't be reached"),
        (corpus(("a", "#"), ("b", "#"), ("a", "##")), "mine: two designs are named 'a': rename one"),
        ("designs = []", "mine: designs: List should have at least 1 item"),
        ("", "mine: designs: missing: add it"),
        ('[[designs]]\nname = "a"', r"mine: designs\.0\.design: missing: add it"),
        ('[[designs]]\nname = "a"\ndesign = 3', r"mine: designs\.0\.design: Input should be a valid string"),
        (corpus(("a", "#")) + "limit = 3", r"mine: designs\.0\.limit: unknown key: remove it; known are name, design"),
        ("[[designs]", "mine: not TOML"),
    ],
)
def test_a_mistake_is_refused_in_one_line_that_says_where(text: str, says: str) -> None:
    with pytest.raises(ScenarioError, match=f"^{says}") as caught:
        parse_corpus(text, "mine", LINE)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_refused_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(ScenarioError, match="can't be read"):
        load_corpus(tmp_path / "none.toml", LINE)


def test_a_design_that_the_builder_can_not_build_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mc_nested.arena.design.scenario_of_design", lambda *_: None)
    with pytest.raises(ScenarioError, match="mine: design 'a': the scripted builder can't build it: draw another"):
        parse_corpus(corpus(("a", "#")), "mine", LINE)
