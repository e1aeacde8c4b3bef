"""Requests to the main thread, and its answers."""

import threading

import pytest

from mc_nested.errors import ClusterError
from mc_nested.workers.games.desk import CLOSED, Desk
from mc_nested.workers.games.order import GameAnswer
from tests.workers.games.made_orders import ORDER


def asked(desk: Desk) -> tuple[threading.Thread, list[GameAnswer]]:
    answers: list[GameAnswer] = []
    thread = threading.Thread(target=lambda: answers.append(desk.ask(ORDER, None, lambda: True)))
    thread.start()
    return thread, answers


def test_whoever_asks_waits_for_the_answer() -> None:
    desk = Desk()
    thread, answers = asked(desk)
    request = desk.next()
    assert request
    assert (request.order, request.plan) == (ORDER, None)
    request.answer.set_result(GameAnswer(problem="no"))
    thread.join(5)
    assert answers == [GameAnswer(problem="no")]


def test_without_a_request_there_is_none_after_a_moment() -> None:
    assert Desk().next() is None


def test_closing_the_desk_tells_whoever_waits_or_asks_later() -> None:
    desk = Desk()
    thread, answers = asked(desk)
    desk.close()
    thread.join(5)
    assert answers == [CLOSED]
    assert desk.ask(ORDER, None, lambda: True) == CLOSED


def test_a_refusal_ends_the_main_thread() -> None:
    desk = Desk()
    desk.refuse(ClusterError("another version"))
    with pytest.raises(ClusterError, match="another version"):
        desk.next()


def test_an_answer_that_came_before_it_was_closed_is_kept() -> None:
    desk = Desk()
    thread, answers = asked(desk)
    request = desk.next()
    assert request
    request.answer.set_result(GameAnswer(problem="first"))
    desk.close()
    thread.join(5)
    assert answers == [GameAnswer(problem="first")]
