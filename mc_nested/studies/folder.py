"""The folder of a study: config.toml, and jobs/ with each job's checkpoint or outcome."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path

import tomlkit

from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import RunError
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.learn.runs.folder_kind import check_config, check_free, verb_of_study
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import JobOutcome, outcome_of
from mc_nested.toml_file import parse_toml, read_toml_text

CONFIG, JOBS_FOLDER, STAMP = "config.toml", "jobs", "config.sha256"


class StudyFolder:
    """The folder of one study.

    Args:
        path: its path.
        config: what is trained there.
    """

    def __init__(self, path: Path, config: StudyConfig) -> None:
        self.path = path
        self.config = config
        self.jobs = config.cut()

    @classmethod
    def new(cls, path: Path, config: StudyConfig) -> "StudyFolder":
        """Return a folder for a new study; RunError if the path holds anything already. Nothing is written yet."""
        check_free(path)
        return cls(path, config)

    @classmethod
    def open(cls, path: Path, verbs: Sequence[str] = ()) -> "StudyFolder":
        """Return the folder of an earlier study, of one of those verbs if any is named.

        RunError if it isn't one, or its config was changed since.
        """
        file = path / CONFIG
        if not file.is_file():
            what = f"mc-nested {verbs[0]}" if verbs else "a study"
            raise RunError(f"{path}: no {CONFIG} there: name a folder of {what} (its --out)")
        text = read_toml_text(file, RunError)
        check_config(text, path, *verbs)
        folder = cls(path, parse_toml(StudyConfig, text, str(file), RunError))
        stamp = path / JOBS_FOLDER / STAMP
        if stamp.exists() and stamp.read_text("utf-8", errors="replace").strip() != folder._stamp:
            raise RunError(
                f"{file}: was changed after the study began, so what is trained already wouldn't fit: put it back as "
                f"it was, or start over with another --out"
            )
        return folder

    @property
    def resume_command(self) -> str:
        """The command that resumes it."""
        return f"mc-nested {verb_of_study(self.config.study)} --resume {self.path}"

    def begin(self) -> None:
        """Make the folder and write the config, unless they are there; RunError if the disk refuses."""
        with refused_as(RunError, self.path, "name another folder, or make room"):
            (self.path / JOBS_FOLDER).mkdir(parents=True, exist_ok=True)
            for file, text in (
                (self.path / CONFIG, tomlkit.dumps(self.config.model_dump(exclude_none=True))),
                (self.path / JOBS_FOLDER / STAMP, f"{self._stamp}\n"),
            ):
                if not file.exists():
                    with atomic_write(file) as unfinished:
                        unfinished.write_text(text, encoding="utf-8")

    def folder_of(self, job: Job) -> Path:
        """Return the job's own folder."""
        return self.path / JOBS_FOLDER / job.name

    def outcomes(self) -> list[tuple[Job, JobOutcome | None]]:
        """Return every job with its outcome, None if it isn't finished; RunError if a file can't be used."""
        return [(job, outcome_of(job, self.folder_of(job))) for job in self.jobs]

    def writing(self) -> AbstractContextManager[None]:
        """Raise RunError, one line that says how to resume, if the disk refuses what the block writes here."""
        return refused_as(RunError, self.path, f"make room, then {self.resume_command} goes on")

    @property
    def _stamp(self) -> str:
        return fingerprint(self.config.model_dump(exclude={"format"}, exclude_none=True))
