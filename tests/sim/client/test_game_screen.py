"""Reading the virtual client's window: the chat's line, menus, and the last frames."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.live_game import LiveGame
from mc_nested.live.menus import recovery, screens
from mc_nested.live.menus.chat import Chat
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import LastFrames, without_chat
from mc_nested.live.vision.game_screen import WindowScreen
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from tests.sim.client.playing import FONT, arena_of, command, connection_to, play, screen_of

LINE = load_scenario("line")


def _screen(client: VirtualClient) -> WindowScreen:
    client.clock.sleep(0.2)
    return screen_of(client)


def _connection(client: VirtualClient) -> GameConnection:
    client.clock.sleep(0.2)
    return connection_to(client)


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1"])
@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_the_open_chat_and_its_exact_text_are_seen(version: str, scale: int) -> None:
    client = VirtualClient(version=version, size=(1366, 768) if scale < 4 else (1920, 1080), scale=scale)
    screen = _screen(client)
    assert not screen.is_chat_open()
    client.game.open("chat")
    client.clock.sleep(0.2)
    assert screen.is_chat_open()
    assert screen.is_typed("")
    client.keyboard.type("/tp @s 1.5 64 3.5 -90 65")
    client.clock.sleep(0.2)
    assert screen.is_chat_open()
    assert screen.is_typed("/tp @s 1.5 64 3.5 -90 65")
    assert not screen.is_typed("/tp @s 1.5 64 3.5 -90 66")
    assert not screen.is_typed("/tp @s 1.5 64 3.5 -90 6")


@pytest.mark.parametrize("width", [640, 661, 689, 717, 731, 759, 815, 857, 899, 913])
def test_a_line_nearly_as_long_as_the_chat_is_seen_at_any_window_width(width: int) -> None:
    client = VirtualClient(size=(width, 480))
    screen = _screen(client)
    client.game.open("chat")
    line = "/execute if blocks 11727 98 -7577 11743 100 -7561 11727 101 -7577 all run tp @s ~ ~ ~ 90 22"
    client.keyboard.type(line[1:])
    client.clock.sleep(0.2)
    assert not screen.is_typed(line[1:-1])
    assert screen.is_typed(line[1:])
    is_whole = len(FONT.columns(f"{line}_")) <= (width // 2) - 8
    assert not (is_whole and screen.is_typed(line)), "a first letter that was lost is noticed wherever it would be seen"


def test_an_open_chat_is_seen_to_be_empty_until_a_letter_is_typed() -> None:
    client = VirtualClient(world="dark")
    screen = _screen(client)
    client.game.open("chat")
    client.clock.sleep(0.2)
    assert screen.is_typed("")
    client.keyboard.type("t")
    client.clock.sleep(0.2)
    assert not screen.is_typed("")


def test_a_too_long_line_is_recognised_by_its_visible_end() -> None:
    client = VirtualClient()
    screen = _screen(client)
    client.game.open("chat")
    line = "/item replace entity @s hotbar.0 with minecraft:waxed_weathered_cut_copper_stairs 64"
    client.keyboard.type(line)
    client.clock.sleep(0.2)
    assert screen.is_typed(line)
    assert not screen.is_typed(line[:-1])


@pytest.mark.parametrize("world", ["bright", "dark", "noise", "grey noise", "specks"])
def test_no_world_is_taken_for_an_open_chat(world: str) -> None:
    for seed in range(5):
        assert not _screen(VirtualClient(world=world, seed=seed, pitch=65.0)).is_chat_open()


def test_a_line_that_lost_a_letter_is_not_sent() -> None:
    client = VirtualClient()
    connection = _connection(client)
    connection.controller.confirm_screen("world")
    client.clock.call_at(client.clock.now() + 0.06, lambda: setattr(client.window, "to_drop", 3))
    with pytest.raises(NotConfirmedError, match=r"not seen in the chat|did not open"):
        Chat(Profile(), connection).send("/time set 1")
    assert client.realm.day_time == 6000


@pytest.mark.parametrize("scale", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("draft", ["/tp @s 1 2 3", "hello", "W", "~@#", "it"])
def test_a_draft_is_deleted_before_a_line_is_typed(draft: str, scale: int) -> None:
    client = VirtualClient(version="26.1", size=(320 * scale + 7, 240 * scale + 3), scale=scale, world="bright")
    client.game.chat.draft = draft
    client.clock.sleep(0.2)
    connection = _connection(client)
    assert not connection.screen.is_chat_open()
    connection.controller.confirm_screen("world")
    Chat(Profile(), connection).send("/time set 1")
    client.clock.sleep(0.2)
    assert (client.realm.day_time, client.game.chat.draft) == (1, "")


@pytest.mark.parametrize("scale", range(1, 9))
def test_a_chat_with_a_draft_is_seen_to_be_open_whichever_letter_it_begins_with(scale: int) -> None:
    client = VirtualClient(version="26.1", size=(320 * scale + 7, 240 * scale + 3), scale=scale, world="dark")
    screen, letters = _screen(client), FONT.glyphs.keys() - {"."}
    for letter in letters:
        client.game.chat.draft = f"{letter}ox"
        client.game.open("chat")
        client.clock.sleep(0.2)
        assert screen.is_chat_open(), letter
        client.game.chat.close(keeps_draft=False)
        client.game.open("world")


def test_a_line_on_a_too_light_ground_is_not_sent_and_the_error_names_the_option() -> None:
    options = GameOptions(text_background_opacity=0.0, background_for_chat_only=False)
    client = VirtualClient(version="26.1", world="bright", options=options)
    client.clock.sleep(0.2)
    connection = _connection(client)
    connection.controller.confirm_screen("world")
    with pytest.raises(NotConfirmedError, match=r"Options > Accessibility > Text Background is Chat"):
        Chat(Profile(), connection).send("/time set 1")
    assert (client.game.screen, client.realm.day_time, client.window.down) == ("world", 6000, set())


def test_a_transparent_background_of_the_chat_alone_does_not_hinder_reading() -> None:
    client = VirtualClient(version="26.1", world="bright", options=GameOptions(text_background_opacity=0.0))
    client.clock.sleep(0.2)
    connection = _connection(client)
    connection.controller.confirm_screen("world")
    Chat(Profile(), connection).send("/time set 1")
    client.clock.sleep(0.2)
    assert client.realm.day_time == 1


class ElsewhereScreen(WindowScreen):
    """A screen that never sees the chat, as where a game draws it elsewhere."""

    def is_chat_open(self) -> bool:
        return False


def test_a_chat_drawn_elsewhere_is_closed_and_the_error_names_the_key_to_set() -> None:
    client = VirtualClient()
    client.clock.sleep(0.2)
    connection = _connection(client).with_screen(ElsewhereScreen(client.display, FONT))
    connection.controller.confirm_screen("world")
    with pytest.raises(NotConfirmedError, match=r"the chat did not open, empty: .*set reads_chat = false"):
        Chat(Profile(), connection).send("/time set 1")
    assert client.game.screen == "world"
    assert (client.realm.day_time, client.window.down) == (6000, set())


def test_a_failed_chat_closes_the_menu_that_its_esc_opened() -> None:
    client = VirtualClient()
    client.clock.sleep(0.2)
    connection = _connection(client)
    connection.controller.confirm_screen("world")
    client.window.drop_next()
    with pytest.raises(NotConfirmedError, match="the chat did not open"):
        Chat(Profile(), connection).send("/time set 1")
    assert client.game.screen == "world"


@pytest.mark.parametrize("version", ["1.12.2", "1.16.5", "1.20.1", "1.21.9"])
@pytest.mark.parametrize("name", ["chat", "pause", "death", "disconnected", "servers", "title", "worlds", "inventory"])
def test_recovery_leads_from_every_screen_back_into_the_world(version: str, name: str) -> None:
    client = VirtualClient(version=version)
    connection = _connection(client)
    if name == "disconnected":
        client.game.disconnect("Timed out")
    elif name == "death":
        client.game.die()
    elif name == "title":
        client.game.do("to_title")
    elif name == "worlds":
        client.game.do("to_worlds")
    elif name == "servers":
        client.game.do("to_servers")
    else:
        client.game.open("chat" if name == "chat" else "pause" if name == "pause" else "inventory")
    client.clock.sleep(0.2)
    way = Recovery(Profile(), connection)
    other = "menu" if version == "1.21.9" else "unknown"
    shown: screens.ScreenName = other if name == "inventory" else name  # type: ignore[assignment]  # the rest are names
    assert way.screen_name() == shown
    assert way.recover()[0] == shown
    assert client.game.screen == "world"
    assert client.window.down == set()


def test_recovery_switches_the_debug_screen_on_again() -> None:
    client = VirtualClient(has_f3=False)
    Recovery(Profile(), _connection(client)).recover()
    assert client.game.has_f3


def test_recovery_gives_up_within_a_minute_and_leaves_the_last_frames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 3.0)
    client = VirtualClient()
    client.clock.sleep(0.2)
    client.blacken(1000.0)
    arena = arena_of(client)
    game = LiveGame(
        LINE,
        Profile(arena=arena),
        connection_to(client),
        evidence=tmp_path / "evidence",
    )
    began = client.clock.now()
    with game, pytest.raises(LiveError, match=r"the world was not reached .*; what was seen last: .*last-3\.png"):
        game.reset(1)
    assert client.clock.now() - began < 60.0
    assert len(list((tmp_path / "evidence").glob("*.png"))) == 3


def test_the_chat_is_blanked_on_a_saved_frame(tmp_path: Path) -> None:
    client = VirtualClient(world="bright")
    command(client, "my password is hunter2")
    last = LastFrames(client.display, tmp_path, lambda: client.scale)
    last.take()
    (path,) = last.save()
    saved = cv2.imread(str(path))
    assert saved is not None
    np.testing.assert_array_equal(saved, without_chat(client.display.grab(), client.scale))


def test_another_window_is_never_pictured(tmp_path: Path) -> None:
    client = VirtualClient()
    client.set_front(is_in_front=False)
    last = LastFrames(client.display, tmp_path, lambda: 2)
    last.take()
    assert last.save() == []


def test_a_reset_leads_back_into_the_world_after_the_game_left_it() -> None:
    client = VirtualClient(seed=2)
    with play(client, LINE) as game:
        game.reset(1)
        client.game.do("leave")
        client.clock.sleep(0.3)
        assert game.reset(1) == LINE.start
    assert game.log.recoveries == 1
