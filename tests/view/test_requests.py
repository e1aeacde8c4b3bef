import os
from pathlib import Path

import pytest

from mc_nested.view.files import (
    ANSWER,
    FOLDER,
    PAUSE,
    RENEWED_S,
    STOP,
    TAKEOVER,
    Requests,
    YesOrNo,
    ask,
    ask_to_go_on,
    give_answer,
    renew_pause,
)


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def run(tmp_path: Path) -> Path:
    (tmp_path / FOLDER).mkdir()
    return tmp_path


def renewed(run: Path, nanoseconds: int) -> None:
    """Renew the pause as a view does, at that time."""
    os.utime(run / FOLDER / PAUSE, ns=(nanoseconds, nanoseconds))


def test_a_new_run_has_no_requests(run: Path) -> None:
    requests = Requests(run)

    assert not requests.is_pause_asked()
    assert not requests.is_stop_asked()
    assert requests.answer_to(1) is None


def test_requests_to_an_earlier_run_are_forgotten(run: Path) -> None:
    ask(PAUSE, run)
    ask(STOP, run)
    give_answer(run, YesOrNo(number=1, is_yes=True))

    requests = Requests(run)

    assert not requests.is_pause_asked()
    assert not requests.is_stop_asked()
    assert requests.answer_to(1) is None


def test_pause_lasts_until_somebody_asks_to_go_on(run: Path) -> None:
    requests = Requests(run)
    ask(PAUSE, run)
    assert requests.is_pause_asked()
    ask_to_go_on(run)
    assert not requests.is_pause_asked()
    ask_to_go_on(run)


def test_pause_ends_if_nobody_renews_it(run: Path) -> None:
    clock = Clock()
    requests = Requests(run, clock)
    ask(PAUSE, run)
    assert requests.is_pause_asked()
    clock.now += RENEWED_S - 0.1
    renewed(run, 1)
    assert requests.is_pause_asked()
    clock.now += RENEWED_S - 0.1
    assert requests.is_pause_asked()
    clock.now += 0.2
    assert not requests.is_pause_asked()


def test_a_view_renews_a_pause_unless_another_one_ended_it(run: Path) -> None:
    ask(PAUSE, run)
    assert renew_pause(run)
    ask_to_go_on(run)
    assert not renew_pause(run)
    assert not Requests(run).is_pause_asked()


def test_a_stop_is_heard_beside_any_other_request(run: Path) -> None:
    requests = Requests(run)
    ask(STOP, run)
    ask(PAUSE, run)
    ask_to_go_on(run)
    give_answer(run, YesOrNo(number=1, is_yes=True))

    assert requests.is_stop_asked()


def test_answer_counts_only_for_its_own_question(run: Path) -> None:
    requests = Requests(run)
    give_answer(run, YesOrNo(number=7, is_yes=False))

    assert requests.answer_to(7) is False
    assert requests.answer_to(8) is None


@pytest.mark.parametrize("text", ["", "{", '{"number": 1}', '{"number": "one", "is_yes": true}'])
def test_a_damaged_answer_counts_as_none(run: Path, text: str) -> None:
    requests = Requests(run)
    (run / FOLDER / ANSWER).write_text(text, "utf-8")

    assert requests.answer_to(1) is None


def test_a_run_that_is_gone_can_not_be_asked(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        ask(STOP, tmp_path)
    assert not renew_pause(tmp_path)


def test_an_answer_that_can_not_be_replaced_yet_is_written_again(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    refusals = iter([PermissionError(), PermissionError()])
    replace = Path.replace

    def refused_twice(path: Path, target: Path) -> Path:
        for refusal in refusals:
            raise refusal
        return replace(path, target)

    monkeypatch.setattr(Path, "replace", refused_twice)
    requests = Requests(run)
    give_answer(run, YesOrNo(number=3, is_yes=True))

    assert requests.answer_to(3) is True


def test_each_request_to_take_over_is_taken_once(run: Path) -> None:
    ask(TAKEOVER, run)
    requests = Requests(run)
    assert not requests.takes_takeover(), "it was asked of an earlier run"
    ask(TAKEOVER, run)
    assert requests.takes_takeover()
    assert not requests.takes_takeover()
