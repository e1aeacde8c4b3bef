"""SDL 3, the library of the game's window from 26.3 on, fetched once with pip, pinned with its sha256. Linux only."""

import tempfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

from scripts.programs import ROOT, Say, alone, fetch_wheels

CACHE = ROOT / ".game-windows"


@dataclass(frozen=True)
class Sdl:
    """A release of SDL 3, as it lies in a wheel of tcod."""

    release: str
    platform: str
    wheel: str
    sha256: str
    member: str

    @property
    def library(self) -> Path:
        """The file of the library once it is fetched."""
        return CACHE / f"sdl-{self.release}-{self.platform}" / Path(self.member).name


SDL_3_2 = Sdl(
    "3.2.16",
    "manylinux_2_28_x86_64",
    "tcod==21.0.0",
    "5f36db2a37a791623455ac9a2a9710c96d23ddf56a03d16fbd40df44c25d564b",
    "tcod.libs/libSDL3-3473f499.so.0.2.16",
)
SDL_3_4 = Sdl(
    "3.4.18",
    "manylinux_2_28_x86_64",
    "tcod==21.2.2",
    "be0ae2b75ff49c033f5f1ad274e5716c05dcee016ec983ee5f9382c739e78564",
    "tcod.libs/libSDL3-3fa10a58.so.0.4.18",
)
SDL_3_4_WINDOWS = Sdl(
    "3.4.18",
    "win_amd64",
    "tcod==21.2.2",
    "96e255a781fe943e3276313fd5c5b7f47a308f60d065d06f168129cc008e9986",
    "tcod/x64/SDL3.dll",
)


def fetch_sdl(sdl: Sdl, say: Say) -> Path:
    """Return the library, fetched unless it is there; raise MissingError where that is impossible."""
    CACHE.mkdir(exist_ok=True)
    with alone(CACHE, say, "fetching of a window's library"):
        if not sdl.library.exists():
            say(f"fetching SDL {sdl.release} with pip")
            with tempfile.TemporaryDirectory(dir=CACHE, prefix="fetching-") as scratch:
                pins, part = Path(scratch, f"{sdl.wheel}.txt"), Path(scratch, "library")
                pins.write_text(f"{sdl.wheel} --hash=sha256:{sdl.sha256}\n", encoding="utf-8")
                (wheel,) = fetch_wheels(pins, sdl.platform, Path(scratch), CACHE / "pip.log")
                with zipfile.ZipFile(wheel) as members:
                    part.write_bytes(members.read(sdl.member))
                sdl.library.parent.mkdir(exist_ok=True)
                part.replace(sdl.library)
    return sdl.library
