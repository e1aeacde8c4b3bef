"""Recovery from a server: it never leads through Singleplayer into a world that the agent doesn't belong in."""

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from sim.client.game.screens import ScreenName
from tests.sim.client.playing import arena_of, connection_to

SERVER, OWN = "Minecraft 1.20.1 - Multiplayer (3rd-party Server)", "Minecraft 1.20.1 - Singleplayer"


def way_of(client: VirtualClient) -> Recovery:
    return Recovery(Profile(), connection_to(client))


def titled(client: VirtualClient, monkeypatch: pytest.MonkeyPatch, title: str) -> None:
    """Make the window say that in a world from here on, and on other screens what it says there."""
    says = type(client.display).title

    def title_now() -> str:
        outside = client.game.screen in ("title", "worlds", "servers", "disconnected")
        return says(client.display) if outside else title

    monkeypatch.setattr(client.display, "title", title_now)
    client.clock.sleep(0.3)


@pytest.mark.parametrize("screen", ["title", "worlds", "servers", "disconnected"])
def test_recovery_clicks_nothing_on_menus_after_leaving_a_server(
    screen: ScreenName, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient()
    titled(client, monkeypatch, SERVER)
    way = way_of(client)
    client.game.open(screen)
    client.clock.sleep(0.3)
    monkeypatch.setattr(client.pointer, "press", None)
    with pytest.raises(LiveError, match=f"the server was left, the screen is {screen}: join the server again"):
        way.recover()
    assert client.game.screen == screen


@pytest.mark.parametrize("screen", ["pause", "chat", "death"])
def test_recovery_leads_back_from_screens_within_a_servers_world(
    screen: ScreenName, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient()
    titled(client, monkeypatch, SERVER)
    way = way_of(client)
    if screen == "death":
        client.game.die()
    else:
        client.game.open(screen)
    client.clock.sleep(1.5)
    assert way.recover()[0] == screen
    assert client.game.screen == "world"


@pytest.mark.parametrize(
    ("before", "after", "said"), [(SERVER, OWN, "was a server's, and is your own"), (OWN, SERVER, "is a server's now")]
)
def test_recovery_refuses_a_servers_world_after_an_own_one_and_the_reverse(
    before: str, after: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient()
    titled(client, monkeypatch, before)
    way = way_of(client)
    way.recover()
    titled(client, monkeypatch, after)
    with pytest.raises(LiveError, match=said):
        way.recover()


def test_leave_world_refuses_to_leave_a_servers_world(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient()
    titled(client, monkeypatch, SERVER)
    with pytest.raises(LiveError, match="is not left, since nothing leads back"):
        way_of(client).leave_world()
    assert client.game.screen == "world"


def test_a_reset_types_no_command_after_a_disconnect_from_a_server(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient()
    titled(client, monkeypatch, SERVER)
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client))
    with LiveGame(
        load_scenario("line"),
        profile,
        connection_to(client, is_server_allowed=True),
    ) as game:
        game.reset(1)
        client.mishaps.plan("disconnect", 0.1)
        client.clock.sleep(0.5)
        monkeypatch.setattr(client.keyboard, "type", None)
        with pytest.raises(LiveError, match="join the server again"):
            game.reset(1)
    assert client.game.screen == "disconnected"
