"""ablation.md says what the rows say."""

from mc_nested.report.ablation_text import ablation_text
from tests.report.made_ablation import made_ablation

TEXT = ablation_text(made_ablation())


def cells_of(name: str) -> list[str]:
    line = next(line for line in TEXT.splitlines() if line.startswith(f"| {name} "))
    return [cell.strip() for cell in line.replace(r"\|", "/")[1:-1].split("|")]


def test_a_line_has_the_figures_of_its_part() -> None:
    assert cells_of("whole")[:3] == ["whole", "", "4 of 4"]
    assert cells_of("whole")[3].startswith("6.5 (5 to ")
    assert cells_of("whole")[4:] == ["9", "21", "1,500", "200"]
    assert cells_of("old")[-1] == "3,000"


def test_never_is_infinite_and_a_name_breaks_no_table() -> None:
    assert cells_of(r"no \| hope") == [
        "no / hope",
        "nothing is imagined to pay",
        "1 of 4",
        *cells_of(r"no \| hope")[3:],
    ]
    assert cells_of(r"no \| hope")[3].startswith("∞")
    assert cells_of(r"no \| hope")[4] == "∞"


def test_it_says_that_there_is_no_imitation_in_live() -> None:
    assert "`live` is double Q-learning alone: there is no imitation in it" in TEXT
    assert "4 trials of each line on each design, seed 0" in TEXT
    assert "](ablation.png)" in TEXT
    assert "## zig|zag, optimum 21" in TEXT
