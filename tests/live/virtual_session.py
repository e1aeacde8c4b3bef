"""A live game opened as on a desktop, from a profile on disk, on the virtual client."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import replace
from pathlib import Path

import cv2

from mc_nested.arena.scenario import Scenario
from mc_nested.live.devices import Devices, Display
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile, ScreenTable
from mc_nested.live.session import Opening, open_live_game
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas

OpenDevices = Callable[[str], AbstractContextManager[Devices]]

ARENA = Arena.around((-20, 64, 31), "south")
"""On the client's floor."""


def font_in(folder: Path) -> ScreenTable:
    """Return the project's own font as a picture in that folder."""
    font = folder / "ascii.png"
    font.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return ScreenTable(font=str(font))


def saved(profile: Profile, folder: Path) -> str:
    """Return the profile's file in that folder."""
    save_profile(profile, folder / "mine.toml")
    return str(folder / "mine.toml")


def profile_in(folder: Path) -> str:
    """Return the file of a profile for the virtual client as it comes."""
    return saved(Profile(screen=font_in(folder), arena=ARENA), folder)


def opener(client: VirtualClient, titles: list[str]) -> OpenDevices:
    """Opens that client's window, and notes the title that was asked for."""

    @contextmanager
    def opened(title: str) -> Iterator[Devices]:
        titles.append(title)
        yield client.devices

    return opened


def opening_on(client: VirtualClient, profile: str, say: Callable[[str], None] = print) -> Opening:
    """Opens that client's window, without a panic switch and a takeover key."""

    def nothing(*_: object) -> AbstractContextManager[None]:
        return nullcontext()

    devices = opener(client, [])
    return Opening(profile, say, open_devices=devices, open_panic_switch=nothing, open_takeover_key=nothing)


def live_on(client: VirtualClient) -> Callable[..., AbstractContextManager[tuple[LiveGame, Display]]]:
    """``open_live_game`` for that client's window, whatever window the opening would open."""

    def opened(scenario: Scenario, opening: Opening) -> AbstractContextManager[tuple[LiveGame, Display]]:
        here = opening_on(client, opening.profile)
        theirs = {name: getattr(here, name) for name in ("open_devices", "open_panic_switch", "open_takeover_key")}
        return open_live_game(scenario, replace(opening, **theirs))

    return opened
