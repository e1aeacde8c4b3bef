import json
import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import RunError
from mc_nested.view import files
from mc_nested.view.files import (
    FOLDER,
    HISTORY,
    KEEP_EVERY_S,
    MOST_KEPT,
    NOW,
    Scrubber,
    StatusFiles,
    history_of,
    remove_status,
    status_now,
)
from mc_nested.view.status import FORMAT, Learning, Status
from tests.view.shown import LIVE


def at(seconds: float, **fields: object) -> Status:
    return LIVE.model_copy(update={"at": seconds, **fields})


def test_a_written_status_is_read_back(tmp_path: Path) -> None:
    StatusFiles(tmp_path).write(LIVE)

    assert status_now(tmp_path) == LIVE
    assert list(history_of(tmp_path)) == [LIVE]


def test_a_status_that_is_just_being_replaced_is_read_a_moment_later(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    StatusFiles(tmp_path).write(LIVE)
    refused, read = [2], Path.read_bytes

    def read_bytes(path: Path) -> bytes:
        if refused[0]:
            refused[0] -= 1
            raise PermissionError(13, "Permission denied")
        return read(path)

    monkeypatch.setattr(Path, "read_bytes", read_bytes)
    assert status_now(tmp_path) == LIVE
    refused[0] = 1_000_000
    monkeypatch.setattr(files, "REPLACED_WITHIN_S", 0.05)
    with pytest.raises(RunError, match="can't be read, Permission denied: let this account read it"):
        status_now(tmp_path)


def test_the_status_now_is_the_last_one_and_the_history_has_every_one(tmp_path: Path) -> None:
    files = StatusFiles(tmp_path)
    for number in range(5):
        files.write(at(number))

    assert status_now(tmp_path).at == 4
    assert [status.at for status in history_of(tmp_path)] == [0, 1, 2, 3, 4]


def test_at_most_three_statuses_a_second_are_kept(tmp_path: Path) -> None:
    files = StatusFiles(tmp_path)
    for number in range(10):
        files.write(at(number * KEEP_EVERY_S / 10))

    assert len(history_of(tmp_path)) == 1


def test_the_last_status_is_always_kept(tmp_path: Path) -> None:
    files = StatusFiles(tmp_path)
    files.write(at(1.0))
    files.write(at(1.01, ended="finished"))

    assert [status.ended for status in history_of(tmp_path)] == [None, "finished"]


def test_history_of_a_long_run_is_thinned_but_reaches_from_first_to_last(tmp_path: Path) -> None:
    files = StatusFiles(tmp_path)
    for number in range(3 * MOST_KEPT):
        files.write(at(float(number)))

    times = [status.at for status in history_of(tmp_path)]

    assert times[0] == 0
    assert times[-1] >= 3 * MOST_KEPT - 8
    assert MOST_KEPT // 2 <= len(times) <= MOST_KEPT
    assert times == sorted(times)


def test_a_resumed_run_goes_on_with_its_history(tmp_path: Path) -> None:
    StatusFiles(tmp_path).write(at(1.0))
    StatusFiles(tmp_path).write(at(50.0))

    assert [status.at for status in history_of(tmp_path)] == [1.0, 50.0]


def test_history_line_cut_off_by_a_kill_is_left_out(tmp_path: Path) -> None:
    StatusFiles(tmp_path).write(at(1.0))
    path = tmp_path / FOLDER / HISTORY
    path.write_text(path.read_text("utf-8") + '{"at": 2.0, "wha', "utf-8")
    assert [status.at for status in history_of(tmp_path)] == [1.0]

    StatusFiles(tmp_path).write(at(3.0))
    assert [status.at for status in history_of(tmp_path)] == [1.0, 3.0]


DAMAGED = r"now\.json: can't be read: it is damaged, or of another version"
LATER = f'{{"format": {FORMAT + 1}, "what": "trains", "title": "line"}}'.encode()


@pytest.mark.parametrize(
    ("content", "says"),
    [
        *((text, DAMAGED) for text in (b"", b"{", b"[]", b'{"what": 3}', b'{"what": "train"}')),
        (b'{"format": 1, "what": "train"}', DAMAGED),
        (b"\xff\xfe\x00", "can't be read"),
        (LATER, "another version of mc-nested"),
    ],
)
def test_a_status_that_is_damaged_or_of_another_version_is_refused_in_a_line(
    tmp_path: Path, content: bytes, says: str
) -> None:
    (tmp_path / FOLDER).mkdir()
    (tmp_path / FOLDER / NOW).write_bytes(content)

    with pytest.raises(RunError, match=says):
        status_now(tmp_path)


def test_folder_without_a_status_is_refused_and_has_an_empty_history(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="there is nothing to view"):
        status_now(tmp_path)
    assert history_of(tmp_path) == []


def test_status_file_names_its_format(tmp_path: Path) -> None:
    StatusFiles(tmp_path).write(LIVE)

    assert json.loads((tmp_path / FOLDER / NOW).read_text("utf-8"))["format"] == FORMAT


def test_remove_status_removes_only_published_files(tmp_path: Path) -> None:
    StatusFiles(tmp_path).write(LIVE)
    remove_status(tmp_path)
    assert list(tmp_path.iterdir()) == []

    StatusFiles(tmp_path).write(LIVE)
    (tmp_path / FOLDER / "mine.txt").write_text("mine")
    remove_status(tmp_path)
    assert [path.name for path in (tmp_path / FOLDER).iterdir()] == ["mine.txt"]


@given(st.text(), st.text(), st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_status_with_any_text_and_numbers_is_read_back(doing: str, title: str, since: float, score: float) -> None:
    learning = Learning(score=score, best=-score, scores=(score,))
    status = Status(format=FORMAT, what="train", title=title, doing=doing, since=since, learning=learning)

    with tempfile.TemporaryDirectory() as folder:
        StatusFiles(Path(folder)).write(status)
        assert status_now(Path(folder)) == status
        assert list(history_of(Path(folder))) == [status]


def test_bytes_that_are_not_text_become_question_marks() -> None:
    assert Status(format=FORMAT, what="train", title="r\udce9").title == "r?"


STATUSES = [LIVE.model_copy(update={"at": float(number)}) for number in range(41)]


def test_the_scrubber_moves_by_a_moment_or_a_tenth() -> None:
    past = Scrubber(STATUSES, 20)

    assert past.moved(-1).status.at == 19
    assert past.moved(1).status.at == 21
    assert past.jumped(-1).status.at == 16
    assert past.jumped(2).status.at == 28


@given(st.lists(st.integers(-100, 100)))
def test_the_scrubber_stops_at_both_ends(moves: list[int]) -> None:
    past = Scrubber(STATUSES, 20)
    for move in moves:
        past = past.moved(move)
        assert past.status in STATUSES


def test_the_scrubbers_line_marks_its_place_and_the_times_of_its_ends() -> None:
    assert Scrubber(STATUSES, 0).line(29).plain == "00:00:00 ●────────── 00:00:40"
    assert Scrubber(STATUSES, 20).line(29).plain == "00:00:00 ━━━━━●───── 00:00:40"
    assert Scrubber(STATUSES, 40).line(29).plain == "00:00:00 ━━━━━━━━━━● 00:00:40"


def test_scrubber_draws_a_line_for_a_history_of_one_moment() -> None:
    assert Scrubber(STATUSES[:1], 0).line(25).plain == "00:00:00 ●────── 00:00:00"
