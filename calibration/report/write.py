"""Writes a calibration's report: one HTML file beside the profile, to look at or attach to a bug report."""

import importlib.metadata
from collections.abc import Callable
from pathlib import Path

from calibration.report.findings import load_findings
from calibration.report.page import CalibrationReport, contents, report_html
from calibration.report.privacy import names_here
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import ProfileError
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.toml_file import read_toml_text


def report_path(profile: Path) -> Path:
    """Return where a profile's report is written by default."""
    return profile.with_name(f"{profile.stem}-calibration.html")


def write_report(name: str, out: Path | None, say: Callable[[str], None], *, with_pictures: bool = True) -> None:
    """Write the report of a profile whole or not at all, and say what is in it.

    Args:
        name: the profile's name or file.
        out: the HTML file; None for the one beside the profile.
        say: shows one line.
        with_pictures: whether the pictures are in it.

    Raises:
        ProfileError: the profile, or what lies beside it, can't be read, or the file can't be written.
    """
    profile, path = load_profile(name), profile_path(name)
    text = read_toml_text(path, ProfileError)
    version = importlib.metadata.version("mc-nested")
    made = CalibrationReport(path.stem, profile, text, load_findings(path), version, with_pictures)
    names = names_here()
    out = (out or report_path(path)).expanduser()
    with refused_as(ProfileError, out, "name another --out"):
        out.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(out) as unfinished:
            unfinished.write_text(report_html(made, names), "utf-8")
    say(f"report: {out}")
    for line in contents(made):
        say(f"  - {names.removed_from(line)}")
