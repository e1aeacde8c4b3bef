"""Questions that a person answers in a terminal: after a yes the game is in front again."""

import pytest

from calibration.context import ask_in_terminal
from mc_nested.errors import NotInFrontError
from sim.client.client import VirtualClient
from tests.calibration.contexts import started


def test_after_answering_yes_the_game_is_waited_for() -> None:
    client, said = started(VirtualClient()), list[str]()

    def yes(_question: str) -> bool:
        client.set_front(is_in_front=False)
        client.clock.call_at(client.clock.now() + 2, lambda: client.set_front(is_in_front=True))
        return True

    assert ask_in_terminal(yes, said.append, client.devices)("Build it?") is True
    assert said == ["Switch back to the game."]
    assert client.display.is_in_front()


@pytest.mark.parametrize(("answer", "is_in_front"), [(False, False), (False, True), (True, True)])
def test_answering_no_or_having_the_game_in_front_needs_no_wait(answer: bool, is_in_front: bool) -> None:
    client, said = started(VirtualClient()), list[str]()
    client.set_front(is_in_front=is_in_front)
    before = client.clock.now()
    assert ask_in_terminal(lambda _: answer, said.append, client.devices)("Build it?") is answer
    assert said == []
    assert client.clock.now() == before


def test_game_that_stays_in_the_background_after_a_yes_is_an_error() -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    with pytest.raises(NotInFrontError):
        ask_in_terminal(lambda _: True, lambda _: None, client.devices)("Build it?")
