"""The doctor at work on a virtual client, with a temporary folder as its computer."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from calibration.doctor.check import Check
from calibration.doctor.examination import Examination, examine
from calibration.installation.folders import System
from mc_nested.live.devices import Clipboard, Devices
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable
from sim.client.client import VirtualClient
from tests.calibration.contexts import font_file_in

if TYPE_CHECKING:
    from calibration.installation.processes import Process

GOOD = """version:3465
autoJump:false
forceUnicodeFont:false
fullscreen:false
guiScale:2
lang:en_us
pauseOnLostFocus:false
reducedDebugInfo:false
toggleCrouch:false
key_key.forward:key.keyboard.w
key_key.back:key.keyboard.s
key_key.left:key.keyboard.a
key_key.right:key.keyboard.d
key_key.sneak:key.keyboard.left.shift
key_key.chat:key.keyboard.t
key_key.attack:key.mouse.left
key_key.use:key.mouse.right
key_key.hotbar.1:key.keyboard.1
toggleAttack:false
toggleUse:false
saveChatDrafts:false
debugGuiScale:0
chatVisibility:0
textBackgroundOpacity:0.5
backgroundForChatOnly:true
key_key.friends:key.keyboard.unknown
key_key.debug.overlay:key.keyboard.f3
key_key.debug.modifier:key.keyboard.f3
key_key.debug.copyLocation:key.keyboard.c
"""
"""An options.txt of 26.3 with nothing to mend."""

ENTRIES = (
    '{"DataVersion":4671,"custom":{"minecraft:player_position":"alwaysOn","minecraft:looking_at_block":"alwaysOn",'
    '"minecraft:looking_at_block_state":"alwaysOn"}}'
)
"""A debug-profile.json with nothing to mend, in any version that has one."""


class Computer:
    """A home with one game folder, a font and a profile in it, and a desktop with a game's window or without one.

    Args:
        home: an empty folder.
        options: what options.txt says; None where there is none.
    """

    def __init__(self, home: Path, options: str | None = GOOD) -> None:
        self.system = System("linux", home, {})
        self.options = home / ".minecraft" / "options.txt"
        self.options.parent.mkdir()
        self.entries = self.options.with_name("debug-profile.json")
        if options is not None:
            self.options.write_text(options, "utf-8")
            self.entries.write_text(ENTRIES, "utf-8")
        self.font = font_file_in(home)
        self.profile = home / "mine.toml"
        self.save(Profile(screen=ScreenTable(font=str(self.font)), calibrated=calibrated()))
        self.processes: Sequence[Process] | None = []
        self.said: list[str] = []

    def save(self, profile: Profile) -> None:
        self.profile.unlink(missing_ok=True)
        save_profile(profile, self.profile)

    def jar_with_the_font(self) -> Path:
        """Install a version of the game; return its jar."""
        jar = self.options.parent / "versions" / "1.20.1" / "1.20.1.jar"
        jar.parent.mkdir(parents=True)
        jar.write_bytes(self.font.read_bytes())
        return jar

    def examined(
        self,
        open_devices: Callable[[str], AbstractContextManager[Devices]],
        clipboard: Clipboard | None = None,
        session: Callable[[], str] = lambda: "a virtual desktop",
        font: Path | None = None,
    ) -> Examination:
        return examine(
            str(self.profile),
            say=self.said.append,
            system=self.system,
            open_devices=open_devices,
            clipboard=clipboard,
            session=session,
            processes=lambda: self.processes,
            font=font,
        )


def calibrated() -> CalibratedTable:
    """Return the calibrated facts of a virtual client with its default settings."""
    return CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)


def opened(client: VirtualClient) -> Callable[[str], AbstractContextManager[Devices]]:
    """Open a virtual client's window."""

    @contextmanager
    def open_devices(_title: str) -> Iterator[Devices]:
        yield client.devices

    return open_devices


def rows(found: Examination) -> dict[str, Check]:
    return {check.name: check for check in found.checks}


def statuses(found: Examination) -> dict[str, str]:
    return {check.name: check.status for check in found.checks}
