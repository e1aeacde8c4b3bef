"""What the tests on Xwayland need, with apt: Wayland compositors, their X server, and a screen and a hand for them.

Standard library only. The versions are the distribution's.
"""

from pathlib import Path

from scripts.standin_parts import XDOTOOL, XVFB, Program, Say, apt_install, is_installed

WESTON = Program(("weston",), "weston")
MUTTER = Program(("mutter",), "mutter")
"""GNOME's compositor."""

DBUS = Program(("dbus-daemon",), "dbus-daemon")
WAYLAND_WINDOW = Program(("weston-terminal",), "weston")
XWAYLAND = Program(("Xwayland",), "xwayland")
PROGRAMS = (WESTON, MUTTER, DBUS, WAYLAND_WINDOW, XWAYLAND, XVFB, XDOTOOL)
OPENGL = ("libgl1", "libgl1-mesa-dri")


def install_programs(say: Say, log: Path) -> None:
    """Install missing programs with apt; MissingError where that is impossible."""
    packages = {program.package for program in PROGRAMS if program.path() is None}
    packages |= {package for package in OPENGL if not is_installed(package)}
    if packages:
        apt_install("a test on Xwayland", sorted(packages), say, log)
