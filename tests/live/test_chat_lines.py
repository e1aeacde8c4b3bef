"""Lines of chat are counted, and cleared before they cover the debug screen."""

import pytest

from mc_nested.live.chat_lines import SHOWN_S, ChatLines, chat_room
from mc_nested.live.menus.chat import Chat
from mc_nested.live.profile.tables import GameVersion, Profile
from scripts.benches.live import connection_to
from sim.client.client import VirtualClient

RESET = (
    "/tp @s 0.5 64 0.5 0 65",
    "/fill 20 64 20 22 65 22 minecraft:air",
    "/fill 20 63 20 22 63 22 minecraft:stone keep",
    "/tp @s 0.5 64 0.5 0 65",
    "/time set 6000",
    "/time set 6000",
)


@pytest.mark.parametrize("version", ["1.12.2", "1.13.2", "1.14.4", "1.15.2", "1.16.5", "1.20.1"])
def test_after_each_command_of_two_resets_the_debug_screen_is_read_in_the_smallest_window(version: str) -> None:
    client = VirtualClient(version=version, size=(854, 480), scale=2, pitch=65.0)
    connection = connection_to(client)
    chat = Chat(Profile(game=GameVersion(version=version)), connection)
    for command in (*RESET, *RESET):
        assert connection.screen.read().target is not None, command
        connection.controller.confirm_screen("world")
        chat.send(command)
        client.clock.sleep(0.2)
    assert connection.screen.read().problem is None


def cleared(version: str, size: tuple[int, int], scale: int) -> int:
    """How often the chat is cleared in a reset of five lines."""
    client = VirtualClient(version=version, size=size, scale=scale, pitch=65.0)
    connection, count = connection_to(client), 0
    forget = client.game.chat.clear

    def counted() -> None:
        nonlocal count
        count += 1
        forget()

    client.game.chat.clear = counted  # type: ignore[method-assign]
    chat = Chat(Profile(game=GameVersion(version=version)), connection)
    for command in RESET[1:4] + RESET[1:2]:
        assert connection.screen.read().problem is None
        connection.controller.confirm_screen("world")
        chat.send(command)
    return count


def test_a_reset_of_five_lines_is_cleared_once_where_the_fifth_covers_the_block_and_nowhere_else() -> None:
    assert cleared("1.13.2", (854, 480), 2) == 1
    assert cleared("1.13.2", (1920, 1080), 4) == 0
    assert [cleared(version, (854, 480), 2) for version in ("1.12.2", "1.20.1", "1.21.9", "26.4")] == [0, 0, 0, 0]


def test_lines_that_have_faded_do_not_count() -> None:
    lines = ChatLines()
    lines.note("/tp @s 0 0 0", 1.0)
    lines.note("/fill", 2.0)
    assert lines.after("/fill", 3.0) == 4
    assert lines.after("/fill", 2.5 + SHOWN_S) == 2
    lines.forget()
    assert lines.after("/fill", 3.0) == 0


def test_no_version_without_the_key_or_with_its_text_on_top_is_cleared() -> None:
    assert [chat_room(version) for version in ("1.8.9", "1.9", "1.13", "1.16", "1.21.9")] == [None, 6, 4, 8, None]
    assert chat_room("1.13.2", 270) == 7
