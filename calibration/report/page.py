"""The calibration report: one self-contained HTML file, to look at and to attach to a bug report.

profile, checks, findings -> a page of texts and pictures -> page.html.jinja -> HTML -> the file beside the profile

Every text passes ``Names.removed_from`` and is escaped: the template can't leave that out.
"""

import base64
import importlib.metadata
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any

import cv2
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from calibration.context import ReportPicture
from calibration.doctor.check import Status
from calibration.report.findings import Findings, StepFindings, load_findings
from calibration.report.privacy import Names, names_here
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import ProfileError
from mc_nested.live.devices import Frame
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.profile.tables import Profile
from mc_nested.toml_file import read_toml_text

TITLES: Mapping[str, str] = {
    "try-it": "What was tried",
    "question": "The question",
    "doctor": "Doctor",
    "calibration": "Calibration",
    "font": "Font and screen",
    "arena": "Arena",
    "walk": "Walk",
    "clicks": "Click points",
    "cross-check": "F3+C against the reader",
    "proof": "Acceptance test",
    "actions": "Forty actions",
    "line": "The line",
    "undo": "Put back",
}
"""The steps' titles, in the order of the guided run and of a volunteer's; any other step has its name as title."""

SEEN = "the place where you stood, the game's and the computer's lines on the debug screen, the names of your worlds"
"""The personal things that the pictures of a whole calibration show."""

STATUSES: tuple[Status, ...] = ("fail", "warn", "pass", "skip")
"""The statuses of checks, the worst first."""

SMALL_BYTES = 400_000
"""A picture that is larger than this as PNG goes in as JPEG: twenty must still fit into a bug report."""

JPEG_QUALITY = 88


@dataclass(frozen=True)
class CalibrationReport:
    """The contents of a report, of ``what``.

    ``text`` is the profile's file, comments included; ``version`` this program's.
    """

    name: str
    profile: Profile
    text: str
    findings: Findings
    version: str
    with_pictures: bool = True
    what: str = "Calibration"


def contents(report: CalibrationReport) -> list[str]:
    """Return what is in the file and what isn't, one line each: shown at its top, and to the person who makes it."""
    findings = report.findings
    steps = ", ".join(TITLES.get(step.step, step.step) for step in _in_order(findings.steps))
    lines = sum(len(step.lines) for step in findings.steps)
    return [
        f"the doctor's table: {_count(len(findings.checks), 'check')}"
        if findings.checks
        else "no doctor's table: none was kept",
        f"what was found: {_count(lines, 'line')} ({steps})" if steps else "no findings: none were kept",
        _about_pictures(report),
        *([f"what may be seen on them: {SEEN}"] if report.with_pictures and _titles(findings) else []),
        "the profile's text, with the place of your arena in your world, the folders it names and your own comments",
        "not in it: anything outside the game's window; your home folder is written ~, names of accounts <user>",
    ]


def report_html(report: CalibrationReport, names: Names) -> str:
    """Return the report as one HTML document, without scripts and without anything to fetch."""
    environment = Environment(
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=partial(_without, names),
    )
    template = (resources.files("calibration.report") / "page.html.jinja").read_text("utf-8")
    return environment.from_string(template).render(_page(report))


def _without(names: Names, value: Any) -> Any:
    # Markup comes from this module alone: pictures, whose letters may spell a name by chance.
    return names.removed_from(value) if isinstance(value, str) and not isinstance(value, Markup) else value


def _page(report: CalibrationReport) -> dict[str, Any]:
    findings, calibrated = report.findings, report.profile.calibrated
    statuses = Counter(check.status for check in findings.checks)
    return {
        "name": report.name,
        "what": report.what,
        "program": f"mc-nested {report.version}",
        "contents": contents(report),
        "tiles": _tiles(report),
        "date": calibrated.date if calibrated else None,
        "checked": findings.checked,
        "checks": sorted(findings.checks, key=lambda check: STATUSES.index(check.status)),
        "statuses": [(status, statuses[status]) for status in STATUSES if statuses[status]],
        "steps": [_section(step, with_pictures=report.with_pictures) for step in _in_order(findings.steps)],
        "text": report.text,
    }


def _tiles(report: CalibrationReport) -> list[tuple[str, str]]:
    """Return the fingerprint: the game and the window that this profile is for."""
    calibrated, version = report.profile.calibrated, report.profile.game.version
    if calibrated is None:
        return [("Minecraft", version), ("Calibrated", "not as a whole")]
    window = f"{calibrated.window[0]} x {calibrated.window[1]}" if calibrated.window else "unknown"
    return [
        ("Minecraft", calibrated.version or version),
        ("Window", window),
        ("GUI scale", str(calibrated.scales or "unknown")),
        ("Calibrated", calibrated.date),
        ("Measurements", str(sum(calibrated.samples.values()))),
    ]


def _section(step: StepFindings, *, with_pictures: bool) -> dict[str, Any]:
    return {
        "id": step.step,
        "title": TITLES.get(step.step, step.step),
        "date": step.date,
        "samples": _count(step.samples, "measurement") if step.samples else "",
        "lines": step.lines,
        "pictures": [_figure(picture) for picture in step.pictures] if with_pictures else [],
    }


def _figure(picture: ReportPicture) -> dict[str, Any]:
    height, width = picture.frame.shape[:2]
    return {
        "title": picture.title,
        "note": picture.note,
        "uri": Markup(data_uri(picture.frame)),  # noqa: S704 - made of base64 alone
        "width": width,
        "height": height,
    }


def data_uri(frame: Frame) -> str:
    """Return a picture as a URI that holds it whole: PNG, or JPEG where that would be large."""
    png = cv2.imencode(".png", frame)[1].tobytes()
    kind, data = "png", png
    if len(png) > SMALL_BYTES:
        kind, data = "jpeg", cv2.imencode(".jpg", frame, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])[1].tobytes()
    return f"data:image/{kind};base64,{base64.b64encode(data).decode()}"


def _in_order(steps: Sequence[StepFindings]) -> list[StepFindings]:
    order = list(TITLES)
    return sorted(steps, key=lambda step: order.index(step.step) if step.step in order else len(order))


def _about_pictures(report: CalibrationReport) -> str:
    titles = _titles(report.findings)
    if not titles:
        return "no pictures: none were kept"
    if not report.with_pictures:
        return f"no pictures: {len(titles)} left out"
    shown = "; ".join(titles)
    return f"{_count(len(titles), 'picture')} of the game's window, its chat blanked, or drawn: {shown}"


def _titles(findings: Findings) -> list[str]:
    return [picture.title for step in _in_order(findings.steps) for picture in step.pictures]


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


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
