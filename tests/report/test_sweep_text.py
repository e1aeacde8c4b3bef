"""sweep.md says what the rows say."""

from mc_nested.report.sweep_text import sweep_text
from tests.report.made_sweep import made_sweep


def line_of(text: str, choice: str) -> list[str]:
    return next(
        [cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if f"| {choice} |" in line
    )


def test_a_line_has_the_figures_of_its_variant() -> None:
    cells = line_of(sweep_text(made_sweep()), "state")
    assert cells[:4] == ["single", "state", "blind", "12.00"]
    assert cells[4:6] == ["+2.00", "+2.00 to +2.00"]
    assert cells[6:9] == ["10.00", "+2.00", "+2.00 to +2.00"]
    assert cells[9:] == ["13", "0 of 3", ""]
    assert line_of(sweep_text(made_sweep()), "rate")[10:] == ["2 of 3", "60"]


def test_a_base_is_compared_with_nothing() -> None:
    assert line_of(sweep_text(made_sweep()), r"**base**")[:6] == ["nested", "**base**", "", "20.67", "", ""]


def test_it_says_what_was_run_and_how_many_intervals_there_are() -> None:
    text = sweep_text(made_sweep())
    assert "the preset `paper`, seed 0: 3 trials of 90 episodes" in text
    assert "of 12 intervals some 1 leave out 0" in text
    assert "## zig|zag, optimum 21" in text
    assert "](sweep.png)" in text
