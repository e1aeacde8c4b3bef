"""A calibration's bench on a virtual client, and a profile whose font that client's window is drawn with."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2

from calibration.bench import BenchOf
from calibration.step import Bench
from mc_nested.live.desktop import Desktop
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import GameVersion, Screen
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas


def bench_on(
    client: VirtualClient,
    say: Callable[[str], None] = lambda _: None,
    ask: Callable[[str], bool] = lambda _: True,
) -> BenchOf:
    @contextmanager
    def opened(profile: Profile) -> Iterator[Bench]:
        desktop = Desktop(client.display, client.keyboard, client.pointer, client.clock, client.clipboard)
        with Hands(client.display, client.keyboard, client.pointer, client.clock, profile.input) as hands:
            yield Bench(desktop, hands, say, ask)

    return opened


def profile_of(client: VirtualClient, folder: Path) -> Profile:
    """A profile that knows nothing but the client's version and its font, which is written into the folder."""
    file = folder / "ascii.png"
    cv2.imwrite(str(file), drawn_atlas())
    return Profile(game=GameVersion(version=client.settings.version), screen=Screen(font=str(file)))
