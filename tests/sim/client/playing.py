"""The unchanged live path on a virtual client: what session.py wires to a desktop, wired to the client."""

from mc_nested.arena.scenario import Scenario
from mc_nested.live.coordinates import Facing
from mc_nested.live.debug_screen import Overlay, read_debug_screen
from mc_nested.live.font import font_of
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Arena, GameVersion
from mc_nested.live.reading import Reading
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas

FONT = font_of(drawn_atlas())
TAP_S, SOON_S = 0.05, 0.3


def arena_of(client: VirtualClient, facing: Facing = "south") -> Arena:
    """An arena whose ground is the client's floor."""
    return Arena.around((-20, client.realm.world.floor, 31), facing)


def read(client: VirtualClient) -> Reading:
    return read_debug_screen(client.display.grab(), FONT, Overlay(client.scale, 9, (224, 224, 224)))


def play(client: VirtualClient, scenario: Scenario, facing: Facing = "south") -> LiveGame:
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client, facing))
    return LiveGame(
        scenario,
        profile,
        display=client.display,
        keyboard=client.keyboard,
        pointer=client.pointer,
        clock=client.clock,
        screen=WindowScreen(client.display, FONT),
    )


def tap(client: VirtualClient, *keys: str) -> None:
    """Press keys together, let them go, and wait until the game has taken that in."""
    for key in keys:
        client.keyboard.press(key)
        client.clock.sleep(TAP_S)
    for key in reversed(keys):
        client.keyboard.release(key)
    client.clock.sleep(SOON_S)


def click(client: VirtualClient, x: float, y: float) -> None:
    """Click at a place in GUI pixels."""
    client.pointer.move(round(x * client.scale), round(y * client.scale))
    client.pointer.press("left")
    client.clock.sleep(TAP_S)
    client.pointer.release("left")
    client.clock.sleep(SOON_S)


def command(client: VirtualClient, line: str) -> None:
    """Type a line into the chat and send it."""
    tap(client, "t")
    client.keyboard.type(line)
    client.clock.sleep(SOON_S)
    tap(client, "enter")
