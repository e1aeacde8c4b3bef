"""Commands are typed into a virtual client's chat, and their effect is watched for on its debug screen."""

from pathlib import Path

import pytest

from calibration.command_console import CommandConsole
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.input.input_controller import FRESH_S
from mc_nested.live.menus.chat import Chat
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_over, profile_in, started


@pytest.fixture
def client() -> VirtualClient:
    return started(VirtualClient())


@pytest.fixture
def console(client: VirtualClient, tmp_path: Path) -> CommandConsole:
    return CommandConsole(context_over(client).connection.for_profile(profile_in(tmp_path)), profile_in(tmp_path))


def test_a_command_takes_effect_and_its_effect_is_seen(client: VirtualClient, console: CommandConsole) -> None:
    console.send("/tp @s 3.5 64 5.5 90 30")
    reading = console.watch(lambda seen: seen.pitch == 30.0, 1.0)
    assert reading is not None
    assert (reading.xyz, reading.yaw) == ((3.5, 64.0, 5.5), 90.0)
    assert client.game.screen == "world"
    assert not client.window.down


def test_clearing_the_chat_leaves_the_debug_screen_on(client: VirtualClient, console: CommandConsole) -> None:
    client.game.chat.say("half a screen of words", client.game.ticks)
    began = client.clock.now()
    console.clear()
    assert client.clock.now() - began < 1
    assert client.game.has_f3
    assert not client.window.down
    assert client.game.screen == "world"


def test_the_chat_is_cleared_by_d_while_the_debug_key_is_held(client: VirtualClient, console: CommandConsole) -> None:
    events: list[tuple[str, str, float]] = []
    press, release, began = client.keyboard.press, client.keyboard.release, client.clock.now()

    def pressed(key: str) -> None:
        events.append(("down", key, client.clock.now() - began))
        press(key)

    def released(key: str) -> None:
        events.append(("up", key, client.clock.now() - began))
        release(key)

    client.keyboard.press, client.keyboard.release = pressed, released  # type: ignore[method-assign]
    console.clear()
    assert [(kind, key) for kind, key, _ in events[:4]] == [("down", "f3"), ("down", "d"), ("up", "d"), ("up", "f3")]
    (_, _, first), (_, _, second), (_, _, third), (_, _, last) = events[:4]
    assert (second - first, last - third) == (0.0, 0.0), "a letter alone would walk"
    assert third - first == pytest.approx(0.1, abs=0.01)


@pytest.mark.parametrize("reads_chat", [True, False])
def test_a_stall_just_before_the_chat_is_opened_makes_a_command_late_and_does_not_refuse_it(
    reads_chat: bool, client: VirtualClient, tmp_path: Path
) -> None:
    profile = profile_in(tmp_path)
    profile = profile.model_copy(update={"input": profile.input.model_copy(update={"reads_chat": reads_chat})})

    class StalledChat(Chat):
        def send(self, line: str) -> None:
            stalls.append(line)
            client.clock.sleep(FRESH_S + 0.01)
            super().send(line)

    stalls: list[str] = []
    connection = context_over(client).connection.for_profile(profile)
    console = CommandConsole(connection, profile)
    console._chat = StalledChat(profile, connection)
    console.send("/tp @s 3.5 64 5.5 90 30")
    assert console.watch(lambda seen: seen.pitch == 30.0, 1.0) is not None
    assert stalls == ["/tp @s 3.5 64 5.5 90 30"]


def test_chat_is_never_cleared_if_the_profile_does_not_read_it(client: VirtualClient, tmp_path: Path) -> None:
    profile = profile_in(tmp_path)
    blind = profile.model_copy(update={"input": profile.input.model_copy(update={"reads_chat": False})})
    console = CommandConsole(context_over(client).connection.for_profile(blind), blind)
    for _ in range(4):
        console.send("/time set 6000")
    assert len(client.game.chat.lines(client.game.ticks)) == 4


def test_watch_gives_up_after_the_given_time(client: VirtualClient, console: CommandConsole) -> None:
    began = client.clock.now()
    assert console.watch(lambda seen: seen.pitch == 89.0, 0.5) is None
    assert 0.5 <= client.clock.now() - began < 0.7


def test_an_open_chat_is_not_typed_into(client: VirtualClient, console: CommandConsole) -> None:
    client.game.open("chat")
    client.clock.sleep(0.2)
    with pytest.raises(NotConfirmedError, match="the chat is open"):
        console.send("/time set 6000")
    assert client.game.screen == "chat"


def test_a_debug_screen_that_stays_unreadable_is_an_error_after_the_profiles_patience(
    client: VirtualClient, tmp_path: Path
) -> None:
    profile = profile_in(tmp_path)
    client.game.open("pause")
    client.clock.sleep(0.2)
    began = client.clock.now()
    with pytest.raises(UnreadableError, match="unreadable for too long"):
        CommandConsole(context_over(client).connection.for_profile(profile), profile).read()
    assert profile.body.patience_s <= client.clock.now() - began < profile.body.patience_s + 0.3
