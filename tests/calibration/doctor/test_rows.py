"""Single rows: the display's scaling, the window's size, the clipboard, and how an error becomes a row."""

import pytest

from calibration.doctor.check import NAMES, Check, told
from calibration.doctor.clipboard_row import PROBE, clipboard_row
from calibration.doctor.look import Look
from calibration.doctor.window_rows import scaling_row, size_row
from mc_nested.errors import DesktopError
from mc_nested.live.fingerprint import Seen

Size = tuple[int, int]


def look(pictured: Size, points: Size | None, gui_scale: int | None = 2) -> Look:
    return Look(Seen("Minecraft 1.20.1", pictured, gui_scale), pictured, points, is_in_front=True, shown=None)


@pytest.mark.parametrize(
    ("pictured", "points", "status", "detail"),
    [
        ((854, 480), (854, 480), "pass", "1 pixels to a point: 854 x 480 for 854 x 480"),
        ((1708, 960), (854, 480), "pass", "2 pixels to a point: 1708 x 960 for 854 x 480"),
        ((1281, 720), (854, 480), "warn", "1.5 pixels to a point: 1281 x 720 for 854 x 480"),
        ((1708, 480), (854, 480), "fail", "2 pixels to a point: 1708 x 480 for 854 x 480, but 1 downwards"),
        ((854, 480), None, "skip", "this window's points aren't known"),
    ],
)
def test_the_scaling_is_measured_on_the_picture(pictured: Size, points: Size | None, status: str, detail: str) -> None:
    row = scaling_row(look(pictured, points))
    assert (row.status, row.detail) == (status, detail)
    assert bool(row.fix) == (status in ("warn", "fail"))


def test_a_window_smaller_than_the_games_screens_fails() -> None:
    assert size_row(look((319, 480), None), None).status == "fail"
    assert size_row(look((320, 240), None), None).status == "pass"
    assert size_row(look((320, 240), None, gui_scale=None), None).status == "skip"


class Board:
    """A clipboard that goes wrong at its call number ``fails_at``, and may keep what others write to itself."""

    def __init__(self, text: str = "mine", fails_at: int = 99, *, is_kept: bool = False) -> None:
        self.text, self.left, self.is_kept = text, fails_at, is_kept

    def _call(self) -> None:
        self.left -= 1
        if self.left == 0:
            raise DesktopError("the clipboard holds something else than text: copy any text, start again")

    def read(self) -> str:
        self._call()
        return self.text

    def write(self, text: str) -> None:
        self._call()
        if not self.is_kept:
            self.text = text


def test_a_clipboard_is_tried_out_and_holds_what_it_held() -> None:
    board = Board("a person's text")
    assert clipboard_row(board).status == "pass"
    assert board.text == "a person's text"
    assert clipboard_row(Board("")).status == "pass"
    assert clipboard_row(None).status == "skip"


def test_a_clipboard_that_holds_a_picture_is_left_alone() -> None:
    board = Board("a picture", fails_at=1)
    row = clipboard_row(board)
    assert (row.status, row.detail) == ("warn", "the clipboard holds something else than text")
    assert board.text == "a picture"


@pytest.mark.parametrize("fails_at", [2, 3])
def test_a_clipboard_that_fails_midway_holds_what_it_held(fails_at: int) -> None:
    board = Board(fails_at=fails_at)
    assert clipboard_row(board).status == "warn"
    assert board.text == "mine"
    assert board.text != PROBE


def test_a_clipboard_that_another_program_keeps_is_told() -> None:
    assert clipboard_row(Board(is_kept=True)).detail == "what is written isn't what is read"


def test_an_error_is_what_is_wrong_and_what_to_do() -> None:
    assert told("input", "fail", "it broke: mend it: now") == Check("input", "fail", "it broke", "mend it: now")
    assert told("input", "fail", "it broke").fix == ""


def test_no_row_has_the_name_of_another() -> None:
    assert len(set(NAMES)) == len(NAMES) >= 13
