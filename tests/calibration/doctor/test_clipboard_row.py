"""The clipboard's check: it is tried out, and holds afterwards what it held."""

import pytest

from calibration.doctor.clipboard_row import PROBE, clipboard_row
from mc_nested.errors import DesktopError


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


def test_a_clipboard_that_another_program_keeps_is_reported() -> None:
    assert clipboard_row(Board(is_kept=True)).detail == "what is written isn't what is read"
