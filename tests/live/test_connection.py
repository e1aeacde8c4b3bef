"""A connection: the devices, the one owner of held keys and the screen reader, kept together and released together."""

import dataclasses
from pathlib import Path

import cv2
import pytest

from mc_nested.errors import DesktopError, FontError, ProfileError
from mc_nested.live.connection import GameConnection, overlay_of
from mc_nested.live.devices import Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.store import load_profile, parse_profile
from mc_nested.live.profile.tables import InputTable, Profile, ScreenTable
from mc_nested.live.vision.layout import STANDIN, VANILLA, Overlay
from scripts.standin_game import write_profile
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from tests.live.fake_game import FakeGame, FakeScreen, connection_to, devices_of
from tests.live.menus.fake_menus import FakeMenus, connection_of

SERVER = "Minecraft 1.20.1 - Multiplayer (LAN)"


@pytest.fixture
def font(tmp_path: Path) -> ScreenTable:
    """Return the screen's table of a profile that names a font."""
    path = tmp_path / "ascii.png"
    path.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return ScreenTable(font=str(path))


def connect(profile: Profile, devices: Devices) -> GameConnection:
    return GameConnection(devices, InputController(devices, profile.input)).for_profile(profile)


def connection_without_font(game: FakeGame) -> GameConnection:
    devices = devices_of(game)
    return GameConnection(devices, InputController(devices, game.profile.input))


@pytest.mark.parametrize("error", [None, RuntimeError("it broke"), KeyboardInterrupt()])
def test_every_key_is_up_however_the_connection_is_left(error: BaseException | None) -> None:
    game = FakeGame(Profile())
    caught: BaseException | None = None
    try:
        with connection_to(game) as connection:
            connection.controller.confirm_screen("world")
            connection.controller.press(game.clock.now() + 1.0, "w", "left.shift")
            assert game.down == {"w", "left.shift"}
            if error:
                raise error
    except (RuntimeError, KeyboardInterrupt) as raised:
        caught = raised
    assert caught is error
    assert game.down == set()


def test_entering_gives_the_connection_itself() -> None:
    connection = connection_to(FakeGame(Profile()))
    with connection as entered:
        assert entered is connection


def test_a_connection_without_a_font_has_no_screen_and_says_how_to_get_one() -> None:
    with pytest.raises(ProfileError, match="run mc-nested calibrate font first"):
        _ = connection_without_font(FakeGame(Profile())).screen


def test_connecting_with_a_profile_without_a_font_is_refused() -> None:
    game = FakeGame(Profile())
    with pytest.raises(ProfileError, match=r"screen\.font is missing"):
        connect(Profile(), devices_of(game))
    with pytest.raises(ProfileError, match=r"screen\.font is missing"):
        connection_without_font(game).for_profile(Profile())


def test_connecting_with_an_unreadable_font_is_refused(tmp_path: Path) -> None:
    profile = Profile(screen=ScreenTable(font=str(tmp_path / "none.png")))
    with pytest.raises(FontError):
        connect(profile, devices_of(FakeGame(Profile())))


def test_a_game_is_read_with_the_profiles_font(font: ScreenTable) -> None:
    client = VirtualClient()
    client.clock.sleep(0.3)
    connection = connect(Profile(screen=font), client.devices)
    assert connection.devices is client.devices
    assert connection.screen.read().xyz == client.realm.player.feet
    assert connection.screen.gui_scale() == client.scale


def test_the_controller_has_the_profiles_times(font: ScreenTable) -> None:
    game = FakeGame(Profile())
    connection = connect(Profile(screen=font, input=InputTable(click_s=0.12)), devices_of(game))
    connection = connection.with_screen(FakeScreen(game))
    connection.controller.confirm_screen("world")
    connection.controller.click("right")
    connection.controller.wait(0.11)
    assert game.down == {"right button"}
    connection.controller.wait(0.02)
    assert game.down == set()


@pytest.mark.parametrize("is_server_allowed", [True, False])
def test_a_connection_keeps_its_devices_and_controller_under_another_screen_or_profile(
    font: ScreenTable, is_server_allowed: bool
) -> None:
    game = FakeGame(Profile())
    devices = devices_of(game)
    controller = InputController(devices, game.profile.input)
    first = GameConnection(devices, controller, is_server_allowed=is_server_allowed)
    screen = FakeScreen(game)
    for other in (first.with_screen(screen), first.for_profile(Profile(screen=font))):
        assert other.devices is devices
        assert other.controller is controller
        assert other.is_server_allowed is is_server_allowed
    assert first.with_screen(screen).screen is screen


def titled(title: str, *, is_server_allowed: bool) -> GameConnection:
    devices = connection_of(FakeMenus(window_title=title)).devices
    return GameConnection(devices, InputController(devices, InputTable()), is_server_allowed=is_server_allowed)


def test_a_shared_game_is_refused_unless_servers_are_allowed() -> None:
    with pytest.raises(DesktopError, match=r"Multiplayer \(LAN\)', so others may be playing there"):
        titled(SERVER, is_server_allowed=False).check_single_player()
    titled(SERVER, is_server_allowed=True).check_single_player()
    titled("Minecraft 1.20.1 - Singleplayer", is_server_allowed=False).check_single_player()


def test_a_connection_allows_no_server_by_default_also_for_a_profile(font: ScreenTable) -> None:
    devices = connection_of(FakeMenus(window_title=SERVER)).devices
    profile = Profile(screen=font)
    with pytest.raises(DesktopError, match="--server-allowed"):
        connect(profile, devices).check_single_player()
    allowed = GameConnection(devices, InputController(devices, profile.input), is_server_allowed=True)
    allowed.for_profile(profile).check_single_player()


GREY, WHITE = (224, 224, 224), (255, 255, 255)


@pytest.mark.parametrize(
    ("screen", "overlay"),
    [
        ("", None),
        ("line_pitch = 10\ntext_colour = [255, 255, 255]", None),
        ("layout = 'stand-in'", None),
        ("debug_scale = 6", Overlay(6, VANILLA, GREY)),
        ("debug_scale = 3\nlayout = 'vanilla'\ntext_colour = [1, 2, 3]", Overlay(3, VANILLA, (1, 2, 3))),
        ("debug_scale = 3\nlayout = 'stand-in'", Overlay(3, STANDIN, WHITE)),
        ("debug_scale = 3\nline_pitch = 12", Overlay(3, dataclasses.replace(VANILLA, pitch=12), GREY)),
        (
            "debug_scale = 3\nlayout = 'vanilla'\nline_pitch = 10",
            Overlay(3, dataclasses.replace(VANILLA, pitch=10), GREY),
        ),
    ],
)
def test_a_profile_with_a_debug_scale_gives_an_overlay(screen: str, overlay: Overlay | None) -> None:
    assert overlay_of(parse_profile(f"[screen]\n{screen}\n", "here")) == overlay


def test_the_stand_ins_own_profile_names_its_layout(tmp_path: Path) -> None:
    profile = load_profile(write_profile(tmp_path / "profile.toml", tmp_path / "ascii.png"))
    assert profile.screen.layout == "stand-in"
    assert overlay_of(profile) == Overlay(3, STANDIN, WHITE)
