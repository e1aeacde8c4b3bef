"""The chat: a line is sent only once all of it was seen, and nothing is typed into anything else."""

import pytest

from mc_nested.errors import NotConfirmedError
from mc_nested.live.input.input_controller import FRESH_S
from mc_nested.live.menus.chat import PATIENCE_S, Chat
from mc_nested.live.model.timing import TYPING_LOOK_S
from mc_nested.live.profile.tables import InputTable, Profile
from tests.live.fake_game import FakeGame, FakeScreen, connection_to

LINE = "/tp @s 0.5 64 0.5 0 65"
BLIND = Profile(input=InputTable(reads_chat=False, chat_open_s=0.3, chat_close_s=0.7))


class ChatScreen(FakeScreen):
    """The fake game's screen, counting the looks for an open chat; ``is_open`` and ``typed`` overrule what is there."""

    def __init__(self, game: FakeGame) -> None:
        super().__init__(game)
        self.looks = 0
        self.seen: list[str | None] = []
        self.closed_from_look = 10**6
        self.open_from_look = 10**6
        self.typed_instead: str | None = None

    def shows_world(self) -> bool:
        return True

    def is_chat_open(self) -> bool:
        self.looks += 1
        self.seen.append(self._game.typed())
        if self.looks >= self.closed_from_look:
            return False
        return self.looks >= self.open_from_look or super().is_chat_open()

    def is_typed(self, text: str) -> bool:
        if text and self.typed_instead is not None:
            return text == self.typed_instead
        return super().is_typed(text)


def chat_in(game: FakeGame, screen: ChatScreen) -> Chat:
    connection = connection_to(game, screen)
    connection.controller.confirm_screen("world")
    return Chat(game.profile, connection)


def test_a_line_is_typed_and_sent() -> None:
    game = FakeGame(Profile())
    chat_in(game, ChatScreen(game)).send(LINE)
    assert game.commands == [LINE]
    assert game.presses == ["t", "enter"]
    assert game.typed() is None


def test_the_chat_is_checked_every_eight_letters() -> None:
    # One look at the open chat, one before each of the three parts of 22 letters, one at the closed chat.
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    chat_in(game, screen).send(LINE)
    assert screen.looks == 1 + 3 + 1


def test_a_profile_that_can_not_read_the_chat_waits_fixed_times_instead() -> None:
    game = FakeGame(BLIND)
    screen = ChatScreen(game)
    chat_in(game, screen).send(LINE)
    assert game.commands == [LINE]
    assert screen.looks == 0
    # Two taps of a tick each, and the two waits: typing itself takes no time here.
    assert game.clock.now() == pytest.approx(100.0 + 0.05 + 0.3 + 0.05 + 0.7)


def late_chat_in(game: FakeGame, screen: ChatScreen, closes: bool = False) -> Chat:
    """Return a chat each of whose letters is followed by a stall, in which the chat may close."""
    connection = connection_to(game, screen)
    connection.controller.confirm_screen("world")
    typed = connection.devices.keyboard.type

    def type_and_stall(text: str) -> None:
        typed(text)
        game.clock.sleep_until(game.clock.now() + FRESH_S + 0.01)
        screen.closed_from_look = 0 if closes else screen.closed_from_look

    connection.devices.keyboard.type = type_and_stall  # type: ignore[method-assign]
    return Chat(game.profile, connection)


@pytest.mark.parametrize("profile", [Profile(), BLIND])
def test_letters_that_come_late_are_typed_after_another_look(profile: Profile) -> None:
    game = FakeGame(profile)
    late_chat_in(game, ChatScreen(game)).send(LINE)
    assert game.commands == [LINE]
    assert game.presses == ["t", "enter"]


def test_a_chat_that_closes_while_a_letter_is_late_gets_no_more_letters() -> None:
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    with pytest.raises(NotConfirmedError, match="the chat did not stay open"):
        late_chat_in(game, screen, closes=True).send(LINE)
    assert screen.seen[-1] == LINE[0]
    assert game.commands == []


def test_a_chat_that_does_not_open_in_time_is_an_error_and_nothing_is_typed() -> None:
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    screen.closed_from_look = 1
    with pytest.raises(NotConfirmedError, match=r"the chat did not open, empty: leave mouse .*set reads_chat = false"):
        chat_in(game, screen).send(LINE)
    assert (game.typed(), game.presses, screen.seen) == (None, ["t", "esc"], [""] * len(screen.seen))
    waited = game.clock.now() - 100.0 - 0.05 - 0.05 - game.profile.input.chat_close_s
    assert PATIENCE_S <= waited <= PATIENCE_S + TYPING_LOOK_S + 0.001


def test_a_chat_that_can_not_be_emptied_is_not_typed_into() -> None:
    class Opened(ChatScreen):
        """A chat that holds a letter already."""

        def is_typed(self, text: str) -> bool:
            return text == "x"

    game = FakeGame(Profile())
    screen = Opened(game)
    with pytest.raises(NotConfirmedError, match="did not open, empty"):
        chat_in(game, screen).send(LINE)
    assert (game.typed(), game.commands) == (None, [])
    assert set(game.presses[1:-1]) == {"backspace"}
    assert (game.presses[0], game.presses[-1]) == ("t", "esc")


def test_a_draft_in_the_opened_chat_is_deleted_before_typing() -> None:
    game = FakeGame(Profile())
    game.draft = "/fill 0 0"
    chat_in(game, ChatScreen(game)).send(LINE)
    assert game.commands == [LINE]
    assert game.presses == ["t", "backspace", "enter"]


def test_a_chat_that_closes_during_typing_gets_no_more_letters() -> None:
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    screen.closed_from_look = 3
    with pytest.raises(NotConfirmedError, match="the chat did not stay open"):
        chat_in(game, screen).send(LINE)
    assert screen.seen[-1] == LINE[:8]
    assert (game.typed(), game.commands) == (None, [])


def test_a_line_that_lacks_a_letter_is_not_sent() -> None:
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    screen.typed_instead = LINE[1:]
    with pytest.raises(NotConfirmedError, match=r"'/tp @s 0.5 64 0.5 0 65' was not seen in the chat"):
        chat_in(game, screen).send(LINE)
    assert game.commands == []


def test_a_chat_that_stays_open_after_enter_is_an_error() -> None:
    game = FakeGame(Profile())
    screen = ChatScreen(game)
    screen.open_from_look = 5
    with pytest.raises(NotConfirmedError, match="the chat did not close"):
        chat_in(game, screen).send(LINE)
