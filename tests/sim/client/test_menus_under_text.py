"""Menus below the debug screen's text, which lies over them from 1.21.9 on, at one scale for both."""

import pytest

from calibration.clicks.menu_walk import OWN, MenuWalk
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.menus.screens import LABELS, QUIT
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from sim.client.settings import Size
from tests.sim.client.playing import connection_to, screen_of

VERSIONS = ("1.21.9", "1.21.10", "26.1", "26.3", "26.4")
SIZES = ((854, 480), (1280, 720), (1920, 1080), (2560, 1440))
AS_THE_GUI = GameOptions(debug_gui_scale=-1)


def client_of(version: str, size: Size, *, pitch: float = 65.0, world: str = "noise") -> VirtualClient:
    client = VirtualClient(version=version, size=size, scale=0, pitch=pitch, world=world, options=AS_THE_GUI)
    client.clock.sleep(0.2)
    return client


@pytest.mark.parametrize("world", ["noise", "bright"])
@pytest.mark.parametrize("pitch", [65.0, -80.0])
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("version", VERSIONS)
def test_the_game_menus_buttons_are_found_at_their_places(version: str, size: Size, pitch: float, world: str) -> None:
    client = client_of(version, size, pitch=pitch, world=world)
    client.game.open("pause")
    client.clock.sleep(0.2)
    seen, scale = screen_of(client).menu(), client.scale
    top = (-(-size[1] // scale) - 166) // 4 + 50
    middle = -(-size[0] // scale) // 2
    places = {LABELS["pause"][0]: (middle, top + 10), QUIT: (middle, top + 106)}
    if version not in ("26.3", "26.4"):
        places[OWN] = middle + 53, top + 82
    for label, (x, y) in places.items():
        button = seen.button(label)
        assert button.middle is not None, button.problem
        assert button.is_enabled
        assert abs(button.middle[0] - x * scale) <= 2 * scale
        assert abs(button.middle[1] - y * scale) <= 2 * scale
    for label in (*LABELS["death"], *LABELS["disconnected"], *LABELS["title"], "Disconnect", "Player Reporting"):
        assert seen.button(label).middle is None


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("version", VERSIONS)
def test_recovery_leaves_the_world_and_enters_it_again(version: str, size: Size) -> None:
    client = client_of(version, size)
    way = Recovery(Profile(game=GameVersion(version=version)), connection_to(client))
    began = client.clock.now()
    way.leave_world()
    shown = [client.game.screen]
    way.recover()
    assert [*shown, client.game.screen] == ["title", "world"]
    assert client.clock.now() - began < 20.0


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("version", VERSIONS)
def test_a_menu_walk_records_all_five_points(version: str, size: Size) -> None:
    client = client_of(version, size)
    walk = MenuWalk(connection_to(client), Profile(game=GameVersion(version=version)), lambda _: None)
    walk.visit_pause_menu()
    walk.visit_title()
    assert walk.notes == []
    assert len(walk.points) == 5
    assert walk.is_single_player
    assert client.game.screen == "world"
