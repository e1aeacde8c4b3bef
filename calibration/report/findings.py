"""Checks, findings and pictures that calibrations leave beside a profile for a report.

default.toml
default-calibration/found.json     the last findings of each step, and the doctor's last table
default-calibration/font-1.png     their pictures, by step and number
"""

import dataclasses
import datetime
import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import cv2
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from calibration.context import ReportPicture, StepResult
from calibration.doctor.check import Check, Status
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import PictureError, ProfileError
from mc_nested.live.vision.font import decoded

LIST = "found.json"


class _Table(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True, strict=True)


class CheckFinding(_Table):
    """A row of the doctor's table as it was shown; an older doctor may have named its rows otherwise."""

    name: str
    status: Status
    detail: str
    fix: str = ""


class _PictureFile(_Table):
    title: str
    note: str
    file: str = Field(pattern=r"^[\w.-]+$")


class _StepEntry(_Table):
    step: str
    date: str
    lines: list[str]
    samples: int
    pictures: list[_PictureFile]


class _List(_Table):
    checked: str | None = None
    checks: list[CheckFinding] = []
    steps: list[_StepEntry] = []


@dataclass(frozen=True)
class StepFindings:
    """The findings of a step, as in ``StepResult``, and the day (year-month-day)."""

    step: str
    date: str
    lines: tuple[str, ...]
    samples: int
    pictures: tuple[ReportPicture, ...] = ()


@dataclass(frozen=True)
class Findings:
    """All that is kept beside a profile: the steps in the order of their first run, and the doctor's table."""

    steps: tuple[StepFindings, ...] = ()
    checks: tuple[CheckFinding, ...] = ()
    checked: str | None = None
    """The day of the checks."""


def findings_folder(profile: Path) -> Path:
    """Return the folder beside a profile's file in which findings are kept."""
    return profile.with_name(f"{profile.stem}-calibration")


def save_findings(
    profile: Path, found: Sequence[StepResult], checks: Sequence[Check] = (), today: str | None = None
) -> None:
    """Keep these beside a profile. They replace what the same steps, or the doctor, left before.

    ProfileError where the disk refuses.
    """
    folder, day = findings_folder(profile), today or datetime.date.today().isoformat()
    before = _read(folder)
    entries = {entry.step: entry for entry in before.steps}
    with refused_as(ProfileError, folder, "make room, or mend its permissions"):
        folder.mkdir(parents=True, exist_ok=True)
        for each in found:
            pictures = [
                _PictureFile(title=picture.title, note=picture.note, file=_write(folder, each.step, number, picture))
                for number, picture in enumerate(each.pictures, 1)
            ]
            entries[each.step] = _StepEntry(
                step=each.step, date=day, lines=list(each.lines), samples=each.samples, pictures=pictures
            )
        after = _List(
            checked=day if checks else before.checked,
            checks=[CheckFinding(**dataclasses.asdict(check)) for check in checks] or before.checks,
            steps=list(entries.values()),
        )
        with atomic_write(folder / LIST) as unfinished:
            unfinished.write_text(after.model_dump_json(indent=1), "utf-8")
        named = {picture.file for entry in after.steps for picture in entry.pictures}
        for left in folder.glob("*.png"):
            if left.name not in named:
                left.unlink()


def save_findings_or_warn(
    say: Callable[[str], None],
    profile: Path,
    found: Sequence[StepResult],
    checks: Sequence[Check] = (),
    today: str | None = None,
) -> None:
    """Do as ``save_findings``, after the profile was written, but only warn if it fails."""
    try:
        save_findings(profile, found, checks, today)
    except ProfileError as error:
        say(f"warning: {error}; the profile is written, only the report will lack what was found")


def load_findings(profile: Path) -> Findings:
    """Return what is kept beside a profile, without pictures that are gone; empty where no calibration left anything.

    ProfileError if it can't be read.
    """
    folder = findings_folder(profile)
    found = _read(folder)
    steps = tuple(
        StepFindings(entry.step, entry.date, tuple(entry.lines), entry.samples, tuple(_pictures(folder, entry)))
        for entry in found.steps
    )
    return Findings(steps, tuple(found.checks), found.checked)


def _read(folder: Path) -> _List:
    path = folder / LIST
    try:
        return _List.model_validate(json.loads(path.read_text("utf-8")))
    except FileNotFoundError:
        return _List()
    except (OSError, ValueError, ValidationError) as error:
        raise ProfileError(f"{path}: can't be read: remove that folder, and calibrate again") from error


def _write(folder: Path, step: str, number: int, picture: ReportPicture) -> str:
    name = f"{step}-{number}.png"
    with atomic_write(folder / name) as unfinished:
        unfinished.write_bytes(cv2.imencode(".png", picture.frame)[1].tobytes())
    return name


def _pictures(folder: Path, entry: _StepEntry) -> Iterator[ReportPicture]:
    for each in entry.pictures:
        with suppress(OSError, PictureError):
            yield ReportPicture(each.title, decoded((folder / each.file).read_bytes()), each.note)
