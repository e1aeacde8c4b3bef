"""The whole examination: every check, in any state of computer, desktop and game. Everything tried out is undone."""

import platform as computer
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.doctor.entries_row import entries_row, installed_version, target_row_by_entries
from calibration.doctor.input_row import clipboard_row, input_row
from calibration.doctor.options_rows import option_rows, options_row
from calibration.doctor.profile_rows import fit_row, font_row, profile_row
from calibration.doctor.screen_rows import reduced_by_options, screen_rows, window_rows
from calibration.doctor.snapshot import WindowSnapshot, take_snapshot, wait_until_readable
from calibration.installation.debug_profile import DebugProfile, data_version_in
from calibration.installation.folders import GameFolder, System, client_jars, game_folders, jar_version
from calibration.installation.options_txt import OptionsTxt
from calibration.installation.processes import Process, folders_played, is_same_folder, running_processes
from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.connection import prepare_keyboard
from mc_nested.live.desktop import open_desktop, this_system
from mc_nested.live.devices import Clipboard, Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.tables import Profile


@dataclass(frozen=True)
class Examination:
    """All checks, in the order of ``CheckName``, and what a repair needs to know.

    ``folder`` and ``options`` are the game's. ``is_window_closed`` is true if the desktop has no window of the game,
    None if there was no desktop to look at. ``processes`` are the running programs, None if unknown. ``entries`` is
    what the game's debug-profile.json says, ``data_version`` that of the installed version's jar; None if unknown.
    """

    checks: Sequence[Check]
    profile: Profile
    folder: GameFolder | None
    options: OptionsTxt | None
    is_window_closed: bool | None
    processes: Sequence[Process] | None
    entries: DebugProfile | None = None
    data_version: int | None = None


@dataclass
class _Findings:
    """The checks that are done so far: they stay, whatever happens to the window meanwhile."""

    checks: dict[CheckName, Check] = field(default_factory=dict)
    snapshot: WindowSnapshot | None = None

    def add(self, *checks: Check) -> None:
        self.checks.update({check.name: check for check in checks})


def examine(
    profile_name: str,
    *,
    say: Callable[[str], None],
    system: System,
    clipboard: Clipboard | None = None,
    open_devices: Callable[[str], AbstractContextManager[Devices]] = open_desktop,
    session: Callable[[], str] = lambda: this_system().session_kind(),
    processes: Callable[[], Sequence[Process] | None] | None = None,
    font: Path | None = None,
) -> Examination:
    """Check everything that may keep an agent from playing. Checks that are impossible now are skipped, not left out.

    Args:
        profile_name: a name or a file; it needn't exist.
        say: tells the player what to do.
        system: the computer, as launchers see it.
        clipboard: the desktop's; it is tried out and restored.
        open_devices: opens the window of a title.
        session: the kind of desktop session; raises DesktopError if there is none.
        processes: the running programs; default: ask the system.
        font: the font to read the game with, instead of the profile's or one that is found.
    """
    findings = _Findings()
    profile, check = profile_row(profile_name)
    findings.add(check)
    is_closed, skip_reason = None, "no desktop to look at"
    name = f"{computer.system()} {computer.release()}"
    try:
        findings.add(Check(CheckName.SESSION, "pass", f"{name}, {session()}"))
    except DesktopError as error:
        findings.add(check_from_message(CheckName.SESSION, "fail", f"{name}, {error}"))
    else:
        findings.add(clipboard_row(clipboard))
        is_closed, skip_reason = False, "no window of the game to look at"
        try:
            with open_devices((profile or Profile()).window.title) as devices:
                _examine_window(devices, profile_name, profile, findings, system, say, font)
        except DesktopError as error:
            is_closed = isinstance(error, NoWindowError)
            findings.add(check_from_message(CheckName.WINDOW, "fail", str(error)))
    running = processes() if processes else running_processes(system.platform)
    folder = _folder(system, _version(findings.snapshot, profile), running)
    options = _examine_files(profile_name, profile, findings, system, folder, font)
    entries = _examine_entries(profile, findings, folder, options)
    checks = [findings.checks.get(each) or Check(each, "skip", skip_reason) for each in CheckName]
    data_version = _data_version(system, entries.version) if entries is not None else None
    return Examination(checks, profile or Profile(), folder, options, is_closed, running, entries, data_version)


def _examine_window(
    devices: Devices,
    profile_name: str,
    profile: Profile | None,
    findings: _Findings,
    system: System,
    say: Callable[[str], None],
    named_font: Path | None,
) -> None:
    """Examine an open window, and record its checks. DesktopError if it closes; the checks done by then stay."""
    settings = profile or Profile()
    version = version_in(devices.display.title()) or settings.game.version
    font, check = font_row(profile, system, version, named_font)
    findings.add(check)
    snapshot = findings.snapshot = wait_until_readable(devices, font, settings, say)
    on_screen = screen_rows(snapshot, font)
    findings.add(*window_rows(snapshot, profile), *on_screen, fit_row(profile_name, profile, snapshot.window))
    if any(check.name == CheckName.TARGET_LINE and check.status == "fail" for check in on_screen):
        findings.add(Check(CheckName.INPUT, "skip", f"no key is pressed before the {CheckName.TARGET_LINE} is right"))
        return
    try:
        prepare_keyboard(settings, devices)
    except DesktopError as error:
        findings.add(check_from_message(CheckName.INPUT, "fail", str(error)))
        return
    with InputController(devices, settings.input) as controller:
        findings.add(input_row(devices, controller, lambda: take_snapshot(devices, font, settings), settings.keys))


def _examine_files(
    profile_name: str,
    profile: Profile | None,
    findings: _Findings,
    system: System,
    folder: GameFolder | None,
    named_font: Path | None,
) -> OptionsTxt | None:
    """Examine files, with what the window has shown, if it was seen, and return the options, if they were read."""
    snapshot = findings.snapshot
    if CheckName.FONT not in findings.checks:
        font, check = font_row(profile, system, _version(snapshot, profile), named_font)
        is_missing = named_font is None and font is None and (profile is None or profile.screen.font is None)
        findings.add(Check(check.name, "skip", check.detail, check.fix) if is_missing else check)
    if CheckName.PROFILE_FITS not in findings.checks:
        findings.add(fit_row(profile_name, profile, None))
    options, check = options_row(folder)
    findings.add(check)
    keys, size = (profile or Profile()).keys, snapshot.window.window if snapshot else None
    findings.add(*option_rows(options, keys, size))
    if options is not None and (reduced := reduced_by_options(options, findings.checks)):
        findings.add(reduced)
    return options


def _examine_entries(
    profile: Profile | None, findings: _Findings, folder: GameFolder | None, options: OptionsTxt | None
) -> DebugProfile | None:
    """Examine the debug screen's entries, with what the window has shown, and return what their file says."""
    calibrated = profile.calibrated.version if profile and profile.calibrated else None
    in_title = version_in(findings.snapshot.window.title) if findings.snapshot else None
    version = installed_version(in_title, folder, options, calibrated)
    entries, check = entries_row(folder, version, findings.checks)
    findings.add(check)
    if target := target_row_by_entries(entries, findings.checks):
        findings.add(target)
    return entries


def _data_version(system: System, version: str) -> int | None:
    """Return the data version that the client's jar of that version says to be of, if there is one."""
    jars = client_jars(system, version)[:1]
    return next((data_version_in(jar) for jar in jars if jar_version(jar) == version), None)


def _version(snapshot: WindowSnapshot | None, profile: Profile | None) -> str | None:
    """Return the game's version: by its window's title, else as it was calibrated."""
    in_title = version_in(snapshot.window.title) if snapshot else None
    return in_title or (profile.calibrated.version if profile and profile.calibrated else None)


def _folder(system: System, version: str | None, processes: Sequence[Process] | None) -> GameFolder | None:
    """Return the folder of the running game, if that is known, else the likeliest one."""
    candidates = game_folders(system, version)
    for played in folders_played(processes or ()):
        if folder := next((each for each in candidates if is_same_folder(each.path, played)), None):
            return folder
        if (folder := GameFolder(played, "the game that runs")).options.is_file():
            return folder
    return candidates[0] if candidates else None
