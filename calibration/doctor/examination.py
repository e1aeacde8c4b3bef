"""The whole examination: every row, in any state of computer, desktop and game, with everything tried out undone."""

import platform as computer
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field

from calibration.doctor.check import NAMES, Check, told
from calibration.doctor.clipboard_row import clipboard_row
from calibration.doctor.input_row import input_row
from calibration.doctor.look import Look, look, look_until_read
from calibration.doctor.options_rows import option_rows, options_row
from calibration.doctor.profile_rows import fit_row, font_row, profile_row
from calibration.doctor.screen_rows import reduced_by_options, screen_rows
from calibration.doctor.window_rows import window_rows
from calibration.game.folders import GameFolder, System, game_folders
from calibration.game.options_txt import OptionsTxt
from calibration.game.running import Process, is_same, played_now, running
from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.desktop import Desktop, open_desktop, session_kind
from mc_nested.live.devices import Clipboard
from mc_nested.live.fingerprint import version_in
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.session import overlay_of


@dataclass(frozen=True)
class Examination:
    """All rows, in the order of ``NAMES``, and what a repair needs to know.

    ``folder`` and ``options`` are the game's; ``is_window_closed`` is whether a desktop that was looked at has no
    window of the game, None where it couldn't be looked at; ``processes`` are those that ran, None where nobody knows.
    """

    checks: Sequence[Check]
    profile: Profile
    folder: GameFolder | None
    options: OptionsTxt | None
    is_window_closed: bool | None
    processes: Sequence[Process] | None


@dataclass
class _Known:
    """The rows that are known so far: they stay, whatever happens to the window meanwhile."""

    rows: dict[str, Check] = field(default_factory=dict)
    look: Look | None = None

    def note(self, *rows: Check) -> None:
        self.rows.update({row.name: row for row in rows})


def examine(
    profile_name: str,
    *,
    say: Callable[[str], None],
    system: System,
    clipboard: Clipboard | None = None,
    open_devices: Callable[[str], AbstractContextManager[Desktop]] = open_desktop,
    session: Callable[[], str] = session_kind,
    processes: Callable[[], Sequence[Process] | None] | None = None,
) -> Examination:
    """Look at everything that may keep an agent from playing; each row is there, whatever could be looked at.

    Args:
        profile_name: a name or a file; it needn't exist.
        say: tells the player what to do.
        system: the computer, as launchers see it.
        clipboard: the desktop's, tried out and left as it was.
        open_devices: opens the window of a title.
        session: says what kind of session this is, or raises DesktopError.
        processes: gives the programs that run; left out, the system is asked.
    """
    known = _Known()
    profile, row = profile_row(profile_name)
    known.note(row)
    is_closed, unseen = None, "no desktop to look at"
    name = f"{computer.system()} {computer.release()}"
    try:
        known.note(Check("session", "pass", f"{name}, {session()}"))
    except DesktopError as error:
        known.note(told("session", "fail", f"{name}, {error}"))
    else:
        known.note(clipboard_row(clipboard))
        is_closed, unseen = False, "no window of the game to look at"
        try:
            with open_devices((profile or Profile()).window.title) as desktop:
                _look_at(desktop, profile_name, profile, known, system, say)
        except DesktopError as error:
            is_closed = isinstance(error, NoWindowError)
            known.note(told("game's window", "fail", str(error)))
    now = processes() if processes else running(system.platform)
    folder = _folder(system, _version(known.look, profile), now)
    options = _look_without_window(profile_name, profile, known, system, folder)
    checks = [known.rows.get(name) or Check(name, "skip", unseen) for name in NAMES]
    return Examination(checks, profile or Profile(), folder, options, is_closed, now)


def _look_at(
    desktop: Desktop,
    profile_name: str,
    profile: Profile | None,
    known: _Known,
    system: System,
    say: Callable[[str], None],
) -> None:
    """The rows of a window that is there. DesktopError where it goes away: what is known by then stays known."""
    settings = profile or Profile()
    version = version_in(desktop.display.title()) or settings.game.version
    font, row = font_row(profile, system, version)
    known.note(row)
    overlay = overlay_of(settings)
    seen = known.look = look_until_read(desktop, font, overlay, say)
    known.note(*window_rows(seen, profile), *screen_rows(seen), fit_row(profile_name, profile, seen.seen))
    with Hands(desktop.display, desktop.keyboard, desktop.pointer, desktop.clock, settings.input) as hands:
        known.note(input_row(desktop, hands, lambda: look(desktop, font, overlay), settings.keys.debug))


def _look_without_window(
    profile_name: str, profile: Profile | None, known: _Known, system: System, folder: GameFolder | None
) -> OptionsTxt | None:
    """The rows of files, with what the window has said of them where it was seen; the options, if they were read."""
    if "font" not in known.rows:
        font, row = font_row(profile, system, _version(known.look, profile))
        is_missing = font is None and (profile is None or profile.screen.font is None)
        known.note(Check(row.name, "skip", row.detail, row.fix) if is_missing else row)
    if "profile fits" not in known.rows:
        known.note(fit_row(profile_name, profile, None))
    options, row = options_row(folder)
    known.note(row)
    keys, window = (profile or Profile()).keys, known.look.seen.window if known.look else None
    known.note(*option_rows(options, keys, window))
    if options is not None and (reduced := reduced_by_options(options, known.rows)):
        known.note(reduced)
    return options


def _version(seen: Look | None, profile: Profile | None) -> str | None:
    """The game's version: by its window, else as it was calibrated."""
    titled = version_in(seen.seen.title) if seen else None
    return titled or (profile.calibrated.version if profile and profile.calibrated else None)


def _folder(system: System, version: str | None, processes: Sequence[Process] | None) -> GameFolder | None:
    """The folder of the game that runs, if it says so, else the likeliest one."""
    known = game_folders(system, version)
    for played in played_now(processes or ()):
        if folder := next((each for each in known if is_same(each.path, played)), None):
            return folder
        if (folder := GameFolder(played, "the game that runs")).options.is_file():
            return folder
    return known[0] if known else None
