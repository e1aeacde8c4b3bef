"""Figure 5: a picture of every shape of experiment, the same to the byte each time."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import cv2
import pytest

from mc_nested.studies.reproduce import STUDY, figure5
from mc_nested.studies.results import Results
from mc_nested.studies.study import Report, write_report
from tests.studies.claims.made_results import level, made, the_papers


def widths(folder: Path) -> tuple[int, int]:
    picture = cv2.imread(str(folder / "figure5.png"))
    assert picture is not None
    return picture.shape[1], picture.shape[0]


def draw(folder: Path, results: Results) -> None:
    """Draw the figure as a report draws it."""
    write_report(folder, STUDY, Report([], figure5(results), {}))


def one_scenario() -> Results:
    return made(the_papers("line"))


def test_the_panels_of_three_scenarios_stand_side_by_side(tmp_path: Path) -> None:
    draw(tmp_path, made(the_papers()))
    width, height = widths(tmp_path)
    assert width > 2.5 * height


def test_the_same_results_give_the_same_bytes(tmp_path: Path) -> None:
    pictures = []
    for name in ("first", "second"):
        folder = tmp_path / name
        folder.mkdir()
        draw(folder, one_scenario())
        pictures.append([(folder / f"figure5.{kind}").read_bytes() for kind in ("png", "svg")])
    assert pictures[0] == pictures[1]


def test_other_results_give_another_picture(tmp_path: Path) -> None:
    draw(tmp_path, one_scenario())
    first = (tmp_path / "figure5.png").read_bytes()
    draw(tmp_path, replace(one_scenario(), builder={"line": 7.0}))
    assert (tmp_path / "figure5.png").read_bytes() != first


def test_the_svg_is_whole_and_nothing_unfinished_is_left(tmp_path: Path) -> None:
    draw(tmp_path, one_scenario())
    assert ElementTree.parse(tmp_path / "figure5.svg").getroot().tag.endswith("svg")  # noqa: S314 - our own file
    assert sorted(path.name for path in tmp_path.iterdir()) == ["figure5.png", "figure5.svg", "report.md"]


@pytest.mark.parametrize("trials", [1, 2])
def test_one_or_two_trials_of_one_agent_can_be_drawn(tmp_path: Path, trials: int) -> None:
    draw(tmp_path, made({("nested", "line"): level(20, trials=trials)}))
    assert min(widths(tmp_path)) > 300


def test_a_training_without_evaluations_can_be_drawn(tmp_path: Path) -> None:
    results = one_scenario()
    nothing = {
        key: replace(curve, episodes=curve.episodes[:0], scores=curve.scores[:, :0])
        for key, curve in results.curves.items()
    }
    draw(tmp_path, replace(results, curves=nothing))
    assert min(widths(tmp_path)) > 300


def test_four_scenarios_take_two_rows(tmp_path: Path) -> None:
    draw(tmp_path, made({("nested", name): level(14) for name in ("line", "zigzag", "diamond", "hut")}))
    width, height = widths(tmp_path)
    assert width < 2 * height
