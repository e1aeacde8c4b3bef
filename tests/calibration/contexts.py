"""Contexts over virtual clients, wired as calibration/context.py wires a desktop's; and a font file for them."""

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2

from calibration.context import CalibrationContext, OpenContext
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import GameVersion, Profile, ScreenTable
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


class NoKeys:
    """A keyboard that a calibration must not touch."""

    def press(self, key: str) -> None:
        raise AssertionError(key)

    def go_by_symbols(self, keys: Collection[str]) -> None:
        raise AssertionError(keys)

    release = type = press


def font_file_in(folder: Path) -> Path:
    """Return the virtual clients' own font as a font picture."""
    file = folder / "ascii.png"
    file.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return file


def profile_in(folder: Path) -> Profile:
    """Return a profile that can read virtual clients."""
    return Profile(screen=ScreenTable(font=str(font_file_in(folder))))


def profile_of(client: VirtualClient, folder: Path) -> Profile:
    """Return a profile that knows nothing but the client's version and its font, which is written into the folder."""
    return profile_in(folder).model_copy(update={"game": GameVersion(version=client.settings.version)})


def kept_profile(client: VirtualClient, folder: Path) -> Path:
    """Write the profile that `profile_of` returns; return its file."""
    file = folder / "mine.toml"
    save_profile(profile_of(client, folder), file)
    return file


def context_over(client: VirtualClient, ask: Callable[[str], bool] = lambda _: True) -> CalibrationContext:
    """Return a context whose person says yes by default."""
    controller = InputController(client.devices, Profile().input)
    return CalibrationContext(GameConnection(client.devices, controller), lambda _: None, ask)


def context_on(
    client: VirtualClient,
    say: Callable[[str], None] = lambda _: None,
    ask: Callable[[str], bool] = lambda _: True,
    *,
    is_server_allowed: bool = False,
) -> OpenContext:
    """Open a context, like `context_over`, with the profile's own input; every key is released at the end."""

    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        controller = InputController(client.devices, profile.input)
        with GameConnection(client.devices, controller, is_server_allowed=is_server_allowed) as connection:
            yield CalibrationContext(connection, say, ask)

    return opened


def context_of(client: VirtualClient, ask: Callable[[str], bool] = lambda _: True) -> OpenContext:
    return context_on(client, ask=ask)


def started(client: VirtualClient) -> VirtualClient:
    """Return the client once its first pictures are there."""
    client.clock.sleep(0.3)
    return client
