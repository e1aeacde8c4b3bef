"""The picture of actions that wait, and that overlap: what it takes from the client's run, and that it is drawn."""

from pathlib import Path

import cv2
import pytest

from scripts.overlap_picture import CELLS, Course, course_of, draw_overlap


@pytest.fixture(scope="module")
def waiting() -> Course:
    return course_of(overlaps=False)


@pytest.fixture(scope="module")
def overlapping() -> Course:
    return course_of(overlaps=True)


def test_each_block_stands_after_its_click_and_before_its_outcome_is_reported(
    waiting: Course, overlapping: Course
) -> None:
    for course in (waiting, overlapping):
        for click, stood, reported in zip(course.clicks, course.stood, course.reported, strict=True):
            assert click < stood < reported
        assert len(course.reported) == CELLS


def test_actions_that_wait_take_a_hold_each_and_those_that_overlap_one(waiting: Course, overlapping: Course) -> None:
    assert len(waiting.holds) == CELLS
    assert len(overlapping.holds) == 1


def test_the_player_moves_on_before_the_outcome_is_reported_only_where_actions_overlap(
    waiting: Course, overlapping: Course
) -> None:
    def at_first_report(course: Course) -> float:
        return max(cells for at, cells in zip(course.ticks, course.cells, strict=True) if at <= course.reported[0])

    assert at_first_report(waiting) == pytest.approx(1, abs=0.15)
    assert at_first_report(overlapping) > 1.15


def test_the_picture_is_drawn(tmp_path: Path) -> None:
    draw_overlap(tmp_path / "overlap.png")
    assert cv2.imread(str(tmp_path / "overlap.png")) is not None
