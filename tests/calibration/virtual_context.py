"""A calibration's context on a virtual client, and a profile whose font that client's window is drawn with."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2

from calibration.context import CalibrationContext, OpenContext
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import GameVersion, Profile, ScreenTable
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas


def context_on(
    client: VirtualClient,
    say: Callable[[str], None] = lambda _: None,
    ask: Callable[[str], bool] = lambda _: True,
    *,
    is_server_allowed: bool = False,
) -> OpenContext:
    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        controller = InputController(client.devices, profile.input)
        with GameConnection(client.devices, controller, is_server_allowed=is_server_allowed) as connection:
            yield CalibrationContext(connection, say, ask)

    return opened


def profile_of(client: VirtualClient, folder: Path) -> Profile:
    """Return a profile that knows nothing but the client's version and its font, which is written into the folder."""
    file = folder / "ascii.png"
    cv2.imwrite(str(file), drawn_atlas())
    return Profile(game=GameVersion(version=client.settings.version), screen=ScreenTable(font=str(file)))
