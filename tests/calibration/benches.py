"""Benches over virtual clients, wired as calibration/bench.py wires a desktop's; and a font file that reads them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2

from calibration.bench import BenchOf
from calibration.step import Bench
from mc_nested.live.desktop import Desktop
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Screen
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas

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
    """The virtual clients' own font as a font picture."""
    file = folder / "ascii.png"
    file.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return file


def profile_in(folder: Path) -> Profile:
    """A profile that can read virtual clients."""
    return Profile(screen=Screen(font=str(font_file_in(folder))))


def bench_over(
    client: VirtualClient, ask: Callable[[str], bool] = lambda _: True, say: Callable[[str], None] = lambda _: None
) -> Bench:
    """A bench whose person says yes unless told otherwise."""
    desktop = Desktop(client.display, client.keyboard, client.pointer, client.clock, client.clipboard)
    hands = Hands(client.display, client.keyboard, client.pointer, client.clock, Profile().input)
    return Bench(desktop, hands, say, ask)


def bench_of(client: VirtualClient, ask: Callable[[str], bool] = lambda _: True) -> BenchOf:
    """Opens that bench; every key is up again when it is left."""

    @contextmanager
    def opened(_: Profile) -> Iterator[Bench]:
        bench = bench_over(client, ask)
        with bench.hands:
            yield bench

    return opened


def started(client: VirtualClient) -> VirtualClient:
    """The client once its first pictures are there."""
    client.clock.sleep(0.3)
    return client
