"""Contexts over virtual clients, wired as calibration/context.py wires a desktop's; and a font file for them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2

from calibration.context import CalibrationContext, OpenContext
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import Profile, ScreenTable
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas

SPANISH = {
    "Back to Game": "Volver al juego",
    "Save and Quit to Title": "Guardar y salir",
    "Singleplayer": "Un jugador",
    "Select World": "Elegir mundo",
    "Play Selected World": "Jugar en este mundo",
    "Open to LAN": "Abrir en LAN",
    "Respawn": "Reaparecer",
}
"""What the menus say in another language."""


def font_file_in(folder: Path) -> Path:
    """Return the virtual clients' own font as a font picture."""
    file = folder / "ascii.png"
    file.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return file


def profile_in(folder: Path) -> Profile:
    """Return a profile that can read virtual clients."""
    return Profile(screen=ScreenTable(font=str(font_file_in(folder))))


def context_over(
    client: VirtualClient, ask: Callable[[str], bool] = lambda _: True, say: Callable[[str], None] = lambda _: None
) -> CalibrationContext:
    """Return a context whose person says yes by default."""
    controller = InputController(client.devices, Profile().input)
    return CalibrationContext(GameConnection(client.devices, controller), say, ask)


def context_of(client: VirtualClient, ask: Callable[[str], bool] = lambda _: True) -> OpenContext:
    """Open that context; every key is released at the end."""

    @contextmanager
    def opened(_: Profile) -> Iterator[CalibrationContext]:
        context = context_over(client, ask)
        with context.controller:
            yield context

    return opened


def started(client: VirtualClient) -> VirtualClient:
    """Return the client once its first pictures are there."""
    client.clock.sleep(0.3)
    return client
