import shutil
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from mc_nested.errors import LiveError
from mc_nested.view import publisher as publishing
from mc_nested.view.board import Board
from mc_nested.view.files import (
    FOLDER,
    PAUSE,
    STOP,
    TAKEOVER,
    YesOrNo,
    ask,
    ask_to_go_on,
    give_answer,
    is_published,
    status_now,
)
from mc_nested.view.publisher import LOOK_S, Publisher, press_ctrl_c

PATIENCE_S = 20.0


@pytest.fixture(autouse=True)
def often(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make it publish, and hear requests, fifty times a second, so that no test waits long for it."""
    monkeypatch.setattr(publishing, "PUBLISH_EVERY_S", 0.02)


def until(holds: Callable[[], bool]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < end, "it never came"
        time.sleep(0.01)


def a_publisher(
    folder: Path, stop: Callable[[], None] | None = None, lines: Callable[[], list[str]] | None = None
) -> Publisher:
    return Publisher(Board("train", "a title"), folder, lines or (lambda: ["it said this"]), stop)


class Counted:
    """The lines that a run said, and how often they were asked for: once each time that it is published.

    It also stands for whether anybody sees a question, which is asked each time that an answer is looked for.
    """

    def __init__(self) -> None:
        self.times = 0

    def __call__(self) -> list[str]:
        self.times += 1
        return ["it said this"]

    def until_asked_again(self) -> None:
        """Wait for one more publishing from beginning to end: one may be going on."""
        before = self.times
        until(lambda: self.times >= before + 2)


def test_a_run_is_published_at_once_and_while_it_goes_on(tmp_path: Path) -> None:
    with a_publisher(tmp_path) as publisher:
        assert status_now(tmp_path).lines == ("it said this",)
        assert is_published(tmp_path)
        publisher.board.does("trains")
        until(lambda: status_now(tmp_path).doing == "trains")

    assert status_now(tmp_path).ended == "finished"
    assert not is_published(tmp_path)


@pytest.mark.parametrize(
    ("error", "said"),
    [("the game\nis gone", "the game is gone"), ("go on with r\udce9", "go on with r?")],
    ids=["in one line", "a path that is no text, with question marks"],
)
def test_error_of_a_failed_run_is_published_in_one_line(error: str, said: str, tmp_path: Path) -> None:
    def fail() -> None:
        with a_publisher(tmp_path):
            raise LiveError(error)

    with pytest.raises(LiveError):
        fail()

    assert status_now(tmp_path).ended == said


def test_a_run_waits_while_a_person_wants_a_pause(tmp_path: Path) -> None:
    with a_publisher(tmp_path) as publisher:
        publisher.wait_while_paused()
        assert not publisher.was_paused_lately
        ask(PAUSE, tmp_path)
        until(lambda: publisher.is_paused)
        until(lambda: status_now(tmp_path).pausing)
        waits = threading.Thread(target=publisher.wait_while_paused)
        waits.start()
        until(lambda: status_now(tmp_path).paused)
        assert waits.is_alive()
        ask_to_go_on(tmp_path)
        waits.join(PATIENCE_S)

        assert not waits.is_alive()
        assert publisher.was_paused_lately
        # Windows counts time in steps of up to 16 ms.
        assert LOOK_S - 0.016 < publisher.paused_s < PATIENCE_S
        until(lambda: not status_now(tmp_path).paused)


def test_a_view_takes_over_only_while_that_is_offered(tmp_path: Path) -> None:
    switched: list[str] = []
    with a_publisher(tmp_path) as publisher:
        with publisher.offer_takeover(lambda: switched.append("over")):
            until(lambda: status_now(tmp_path).can_take_over)
            ask(TAKEOVER, tmp_path)
            until(lambda: switched == ["over"])
        until(lambda: not status_now(tmp_path).can_take_over)
        ask(TAKEOVER, tmp_path)
        until(lambda: not (tmp_path / FOLDER / TAKEOVER).exists())
    assert switched == ["over"]


def test_paused_run_waits_no_longer_once_it_is_over(tmp_path: Path) -> None:
    with a_publisher(tmp_path) as publisher:
        ask(PAUSE, tmp_path)
        until(lambda: publisher.is_paused)
        publisher.wait_while_paused(lambda: True)


def test_stop_request_ends_a_pause_and_stops_the_run_once(tmp_path: Path) -> None:
    stops: list[str] = []
    lines = Counted()
    with a_publisher(tmp_path, lambda: stops.append("stop"), lines) as publisher:
        ask(PAUSE, tmp_path)
        until(lambda: publisher.is_paused)
        ask(STOP, tmp_path)
        until(lambda: status_now(tmp_path).stopping)
        publisher.wait_while_paused()
        (tmp_path / FOLDER / STOP).unlink()
        lines.until_asked_again()
        ask(STOP, tmp_path)
        lines.until_asked_again()

    assert stops == ["stop"]


def asked(publisher: Publisher, answers: list[bool | None], looks: Counted) -> threading.Thread:
    asking = threading.Thread(target=lambda: answers.append(publisher.answer("Clear it?", lambda: bool(looks()))))
    asking.start()
    return asking


def test_a_question_waits_for_its_own_answer(tmp_path: Path) -> None:
    answers: list[bool | None] = []
    looks = Counted()
    with a_publisher(tmp_path) as publisher:
        for is_yes in (False, True):  # the same words twice are two questions
            asking = asked(publisher, answers, looks)
            until(lambda: status_now(tmp_path).question == "Clear it?")
            number = status_now(tmp_path).question_number
            give_answer(tmp_path, YesOrNo(number=number - 1, is_yes=not is_yes))
            looks.until_asked_again()
            assert asking.is_alive()
            give_answer(tmp_path, YesOrNo(number=number, is_yes=is_yes))
            asking.join(PATIENCE_S)
            until(lambda: status_now(tmp_path).question is None)

    assert answers == [False, True]


def test_question_gets_no_answer_once_nobody_sees_it(tmp_path: Path) -> None:
    with a_publisher(tmp_path) as publisher:
        assert publisher.answer("Clear it?", lambda: False) is None


def test_run_goes_on_if_its_folder_is_deleted(tmp_path: Path) -> None:
    lines = Counted()
    with a_publisher(tmp_path / "run", lines=lines) as publisher:
        shutil.rmtree(tmp_path / "run", ignore_errors=True)  # Windows keeps the lock, which is open
        publisher.board.does("trains")
        lines.until_asked_again()
        assert publisher._thread.is_alive()


def test_run_goes_on_and_hears_a_stop_if_its_status_cannot_be_written(tmp_path: Path) -> None:
    stops: list[str] = []
    lines = Counted()
    with a_publisher(tmp_path, lambda: stops.append("stop"), lines) as publisher:
        publisher.board.show(arena="no arena")
        lines.until_asked_again()
        ask(STOP, tmp_path)
        until(lambda: bool(stops))
        publisher.board.show(arena=None)

    assert status_now(tmp_path).ended == "finished"


def test_run_goes_on_if_the_folder_of_its_view_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")

    with a_publisher(tmp_path / "file") as publisher:
        publisher.wait_while_paused()


def test_a_publisher_that_was_never_entered_publishes_nothing(tmp_path: Path) -> None:
    publisher = a_publisher(tmp_path)
    publisher.board.does("trains")
    publisher.wait_while_paused()

    assert list(tmp_path.iterdir()) == []


def test_press_ctrl_c_raises_sigint() -> None:
    heard: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _: heard.append(number))
    try:
        thread = threading.Thread(target=press_ctrl_c)
        thread.start()
        thread.join()
        until(lambda: bool(heard))
    finally:
        signal.signal(signal.SIGINT, before)

    assert heard == [signal.SIGINT]
