"""The unchanged live path on a virtual client: what session.py wires to a desktop, wired to the client."""

import shutil
from pathlib import Path

from mc_nested.arena.scenario import Scenario
from mc_nested.live.connection import GameConnection, prepare_keyboard
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.journal import Journal
from mc_nested.live.live_game import LiveGame
from mc_nested.live.menus.reset import MARKER
from mc_nested.live.model.coordinates import Facing
from mc_nested.live.model.reading import Reading
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile, WorldTable
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.layout import VANILLA, Overlay
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.realm import Stack, write_world

FONT = font_of(drawn_atlas())
TAP_S, SOON_S = 0.05, 0.3


def arena_of(client: VirtualClient, facing: Facing = "south") -> Arena:
    """Return an arena whose ground is the client's floor."""
    return Arena.around((-20, client.realm.world.floor, 31), facing)


def read(client: VirtualClient) -> Reading:
    return read_debug_screen(client.display.grab(), FONT, Overlay(client.scale, VANILLA, (224, 224, 224)))


def screen_of(client: VirtualClient) -> WindowScreen:
    """Return what reads the client's window."""
    return WindowScreen(client.display, FONT, version=client.settings.version)


def connection_to(
    client: VirtualClient, journal: Journal | None = None, *, is_server_allowed: bool = False
) -> GameConnection:
    """Return the client, read with its own font; the journal is told what is done there."""
    controller = InputController(client.devices, InputTable())
    screen = screen_of(client)
    return GameConnection(client.devices, controller, screen, is_server_allowed=is_server_allowed, journal=journal)


def play(client: VirtualClient, scenario: Scenario, facing: Facing = "south") -> LiveGame:
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client, facing))
    prepare_keyboard(profile, client.devices)
    return LiveGame(
        scenario,
        profile,
        connection_to(client),
    )


def world_in(client: VirtualClient, scenario: Scenario, folder: Path) -> WorldTable:
    """Save the client's world, ready for a scenario, in a folder and in a template of it."""
    arena, player = arena_of(client), client.realm.player
    player.go_to(arena.centre_of(scenario.start))
    player.look(arena.yaw, 65.0)
    for slot, material in enumerate(scenario.materials):
        player.hotbar[slot] = Stack(
            "planks" if material.block == "oak_planks" and not client.edition.since(1, 13) else material.block, 64
        )
    write_world(client.realm, folder)
    (folder / MARKER).touch()
    template = folder.parent.parent / "template"
    shutil.copytree(folder, template, dirs_exist_ok=True)
    return WorldTable(folder=str(folder), template=str(template), name="New World")


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
