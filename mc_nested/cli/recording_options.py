"""The option that says where a live run's recording is kept, and what it means."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.scenario import Scenario
from mc_nested.errors import RecordingError
from mc_nested.live.recording.run_recorder import (
    OpenRecorder,
    is_recording,
    kept_recordings,
    recordings_folder,
    run_recorder,
)

RecordOption = Annotated[
    str | None,
    typer.Option(
        metavar="DIR|off",
        help="a new folder for the recording of a running game, or none [one among mc-nested recordings]",
    ),
]

RecordingArgument = Annotated[
    Path, typer.Argument(metavar="REC", help="a recording: its name in mc-nested recordings, its folder or its file")
]


def live_recorder(
    record: str | None, what: str, scenario: Scenario | None = None, *, server_allowed: bool = False
) -> OpenRecorder:
    """What opens the recorder of a live run.

    Args:
        record: the option's value.
        what: the run, in a word or two.
        scenario: what is built there, if anything.
        server_allowed: whether to play in a game that others may share.

    Raises:
        RecordingError: the folder holds something already.
    """
    return run_recorder(record, what, partial(typer.echo, err=True), scenario, server_allowed=server_allowed)


def recording_path(named: Path) -> Path:
    """The recording of that name, or at that path; RecordingError if there is none."""
    kept = recordings_folder() / named
    for path in (named, kept):
        if path.exists():
            return path
    known = ", ".join(path.name for path in kept_recordings()[-3:]) or "none yet"
    raise RecordingError(f"no recording {str(named)!r}: the last ones kept are: {known}")


def last_recording() -> Path:
    """The newest recording that is kept; RecordingError if there is none."""
    kept = [path for path in kept_recordings() if is_recording(path)]
    if not kept:
        raise RecordingError("no recording is kept yet: play, train or calibrate in a running game first")
    return kept[-1]
