import pytest

from sim.client.game.chat import LONGEST, ChatLine, VirtualChat
from sim.client.game.widgets import RED, WHITE


def texts(chat: VirtualChat, tick: int) -> list[str]:
    return [line.text for line in chat.lines(tick)]


def test_the_newest_message_comes_first_and_errors_are_red() -> None:
    chat = VirtualChat()
    chat.say("first", 0)
    chat.say("second", 1, is_error=True)
    assert chat.lines(2) == (ChatLine("second", RED, 8), ChatLine("first", WHITE, 8))


@pytest.mark.parametrize(("age", "opacity"), [(0, 8), (180, 8), (185, 4), (190, 2), (194, 1)])
def test_a_message_fades_in_its_last_second(age: int, opacity: int) -> None:
    chat = VirtualChat()
    chat.say("text", 100)
    assert chat.lines(100 + age) == (ChatLine("text", WHITE, opacity),)


@pytest.mark.parametrize("age", [198, 200, 500])
def test_a_faded_message_is_gone_until_the_chat_opens(age: int) -> None:
    chat = VirtualChat()
    chat.say("text", 0)
    assert chat.lines(age) == ()
    chat.typed = ""
    assert chat.lines(age) == (ChatLine("text", WHITE, 8),)


def test_ten_messages_show_and_twenty_while_the_chat_is_open() -> None:
    chat = VirtualChat()
    for number in range(30):
        chat.say(str(number), 0)
    assert texts(chat, 0) == [str(number) for number in range(29, 19, -1)]
    chat.typed = ""
    assert texts(chat, 0) == [str(number) for number in range(29, 9, -1)]


def test_a_cleared_chat_is_empty() -> None:
    chat = VirtualChat()
    chat.say("text", 0)
    chat.clear()
    assert chat.lines(0) == ()


def test_typed_letters_are_appended_and_unprintable_ones_dropped() -> None:
    chat = VirtualChat()
    chat.insert("a\nb")
    chat.insert("c")
    assert chat.typed == "abc"
    chat.backspace()
    assert chat.typed == "ab"


def test_a_typed_line_has_256_characters_at_most() -> None:
    chat = VirtualChat()
    chat.insert("x" * 300)
    assert chat.typed == "x" * LONGEST
    assert LONGEST == 256


def test_selected_text_is_replaced_by_the_next_letter() -> None:
    chat = VirtualChat()
    chat.insert("draft")
    chat.is_selected = True
    chat.insert("n")
    chat.insert("ew")
    assert chat.typed == "new"


def test_selected_text_is_deleted_as_a_whole() -> None:
    chat = VirtualChat()
    chat.insert("draft")
    chat.is_selected = True
    chat.backspace()
    assert (chat.typed, chat.is_selected) == ("", False)
    chat.backspace()
    assert chat.typed == ""


def test_backspace_deletes_a_whole_draft_and_typing_continues_it() -> None:
    for delete, typed in ((True, "x"), (False, "draftx")):
        chat = VirtualChat("draft")
        chat.open()
        assert (chat.typed, chat.is_draft) == ("draft", True)
        if delete:
            chat.backspace()
        chat.insert("x")
        assert (chat.typed, chat.is_draft) == (typed, False)


def test_a_blank_line_is_not_kept_as_a_draft() -> None:
    chat = VirtualChat("before")
    chat.open()
    chat.backspace()
    chat.insert("  ")
    chat.close(keeps_draft=True)
    assert (chat.typed, chat.draft) == (None, "")


def test_closing_a_closed_chat_keeps_its_draft() -> None:
    chat = VirtualChat("draft")
    chat.close(keeps_draft=False)
    assert chat.draft == "draft"


def test_lines_are_shown_on_the_given_ground() -> None:
    chat = VirtualChat()
    chat.say("text", 0)
    assert chat.lines(0, 77) == (ChatLine("text", WHITE, 8, 77),)
    chat.open()
    assert chat.lines(0, 77) == (ChatLine("text", WHITE, 8, 77),)
