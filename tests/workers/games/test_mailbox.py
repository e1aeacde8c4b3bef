"""Requests to the main thread, and its answers."""

import threading

import pytest

from mc_nested.errors import ClusterError
from mc_nested.workers.games.mailbox import CLOSED, GameAnswer, Mailbox
from tests.workers.games.made_setups import SETUP


def asked(mailbox: Mailbox) -> tuple[threading.Thread, list[GameAnswer]]:
    answers: list[GameAnswer] = []
    thread = threading.Thread(target=lambda: answers.append(mailbox.ask(SETUP, None, lambda: True)))
    thread.start()
    return thread, answers


def test_ask_waits_for_the_answer() -> None:
    mailbox = Mailbox()
    thread, answers = asked(mailbox)
    request = mailbox.next()
    assert request
    assert (request.setup, request.plan) == (SETUP, None)
    request.answer.set_result(GameAnswer(problem="no"))
    thread.join(5)
    assert answers == [GameAnswer(problem="no")]


def test_next_returns_none_without_a_request() -> None:
    assert Mailbox().next() is None


def test_closed_mailbox_answers_waiting_and_later_requests() -> None:
    mailbox = Mailbox()
    thread, answers = asked(mailbox)
    mailbox.close()
    thread.join(5)
    assert answers == [CLOSED]
    assert mailbox.ask(SETUP, None, lambda: True) == CLOSED


def test_next_raises_the_refusal() -> None:
    mailbox = Mailbox()
    mailbox.refuse(ClusterError("another version"))
    with pytest.raises(ClusterError, match="another version"):
        mailbox.next()


def test_answer_given_before_the_mailbox_was_closed_is_kept() -> None:
    mailbox = Mailbox()
    thread, answers = asked(mailbox)
    request = mailbox.next()
    assert request
    request.answer.set_result(GameAnswer(problem="first"))
    mailbox.close()
    thread.join(5)
    assert answers == [GameAnswer(problem="first")]
