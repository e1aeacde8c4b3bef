"""A volunteer's run (``mc-nested try-it``): its steps one after the other, and the file of them that can be sent.

FOLDER/profile.toml              this run's own
FOLDER/recordings/1-calibration  what passed between program and window, a recording for each time it was opened
FOLDER/report.html               a page as a calibration's, with what was tried
FOLDER/FOLDER.zip                the file to send: a bug report with that page, the steps and each recording whole
"""

import datetime
import importlib.metadata
import json
import time
import traceback
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import numpy as np

from calibration.arena.build import NO_COPY
from calibration.arena.undo import note_path, undo_built_arena, undo_command
from calibration.bug_report import write_bug_report
from calibration.calibrate_all import calibrate_all, check_gates, registered_steps
from calibration.clicks.find import QUESTION
from calibration.context import ReportPicture, StepResult, context_opener
from calibration.doctor.check import Check, CheckName
from calibration.doctor.examination import Examination
from calibration.report.findings import CheckFinding, Findings, StepFindings
from calibration.report.page import TITLES, CalibrationReport, report_html
from calibration.report.privacy import Names
from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, McNestedError, NotConfirmedError, NotInFrontError, StoppedError, UserError
from mc_nested.live.live_game import started_over
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.recording_file import overview_of
from mc_nested.live.session import Opening, open_live_game
from mc_nested.live.vision.chat_region import without_chat
from mc_nested.live.vision.game_screen import seen_gui_scale

TRIES = 2
"""Of the calibration, and of putting back what stood there: a stall of a busy machine ends one, a wrong game each."""

WHOLE_S = 3600.0
"""More than a recording lasts."""

SEED = 1


@dataclass
class TryItStep:
    """A step as it went, without names: its time, mishaps, and the traceback of what it failed by."""

    step: str
    seconds: float = 0.0
    problems: list[str] = field(default_factory=list)
    failed_by: str = ""

    def __str__(self) -> str:
        problems = "".join(f"; {problem}" for problem in self.problems)
        return f"{TITLES[self.step]}: {self.seconds:.0f} s, {'failed' if self.failed_by else 'done'}{problems}"


class TryIt:
    """A volunteer's run, which is told of its calibration's progress, too.

    Args:
        folder: an empty one, for the profile, the recordings and the file.
        opening: how the game's window is opened.
        examine: the doctor's examination for a profile's file, read with that font; None: one that is found.
        names: what is taken out of all that is written to be sent.
        font: the game's jar or font picture; None: it is looked for.
    """

    def __init__(
        self,
        folder: Path,
        opening: Opening,
        examine: Callable[[str, Path | None], Examination],
        names: Names,
        font: Path | None = None,
    ) -> None:
        self.steps: list[TryItStep] = []
        self._folder, self._profile, self._recordings = folder, folder / "profile.toml", folder / "recordings"
        self._opening, self._look, self._names, self._font = opening, examine, names, font
        self._checks: Sequence[Check] = ()
        self._results: list[StepResult] = []

    def run(self, steps: Mapping[str, Callable[[], None]]) -> None:
        """Take the steps, and raise the error of the first that fails.

        Before that, what stood where the arena was built is put back, unless the person or the game is gone.
        """
        try:
            for number, (name, take) in enumerate(steps.items(), 1):
                self._opening.say(f"{number}/{len(steps)} {TITLES[name]}")
                self._take(name, take)
        except McNestedError as error:
            is_gone = isinstance(error, (StoppedError, NotInFrontError, DesktopError))
            if self._is_built and not is_gone and self.steps[-1].step != "undo":
                with suppress(McNestedError):
                    self._take("undo", self.put_back)
            raise

    def _take(self, name: str, take: Callable[[], None]) -> None:
        step, began = TryItStep(name), time.monotonic()
        self.steps.append(step)
        try:
            take()
        except BaseException as error:
            step.problems.append(self._names.removed_from(f"{type(error).__name__}: {error}"))
            step.failed_by = self._names.removed_from(traceback.format_exc())
            raise
        finally:
            step.seconds = round(time.monotonic() - began, 1)
            self._say(f"[{step.seconds:.0f} s]")

    def _say(self, line: str) -> None:
        self._opening.say(f"    {line}")

    def _note(self, problem: str) -> None:
        """Show the person a problem, and keep it with the step."""
        self.steps[-1].problems.append(self._names.removed_from(problem))
        self._say(problem)

    def how_it_failed(self, error: BaseException) -> str:
        """Say where the run failed, why, and how what stood there comes back, if it isn't back already."""
        where = next((TITLES[step.step] for step in self.steps if step.failed_by), "Try-it")
        is_back = self.steps[-1].step == "undo" and not self.steps[-1].failed_by
        left = "; what stood where it built is back already" if is_back else ""
        if self._is_built:
            left = f"; what stood where it built comes back with {undo_command(self._profile)}"
        return f"{where}: {str(error) or 'stopped'}{left}"

    @property
    def _is_built(self) -> bool:
        """Whether this run's arena stands in the world."""
        is_known = self._profile.is_file() and load_profile(self._profile).arena is not None
        return is_known or note_path(self._profile).is_file()

    def _opened(self) -> Opening:
        """Return how the step opens the window, with a recording of its own."""
        name = self.steps[-1].step
        record = self._recordings / f"{len(list(self._recordings.glob('*'))) + 1}-{name}"
        return replace(self._opening, profile=str(self._profile), what=f"try-it-{name}", record=record, say=self._say)

    def examine(self, ask_font: Callable[[], Path | None]) -> None:
        """Look at computer and game; ask for the game's font where none is found. DesktopError where a gate fails."""
        self._checks = self._look(str(self._profile), self._font).checks
        if any(check.name == CheckName.FONT and check.status == "fail" for check in self._checks):
            self._font = ask_font()
            self._checks = self._look(str(self._profile), self._font).checks
        check_gates(self._checks)

    def calibrate(self) -> None:
        """Calibrate the profile of this run."""
        steps = registered_steps(self._font, path=self._profile)

        def calibrated() -> object:
            opened = context_opener(self._opened(), _agrees)
            return calibrate_all(str(self._profile), opened, lambda _: self._checks, steps, self)

        started_over(calibrated, self._note, TRIES)

    def play(self, scenario: Scenario, take: Callable[[ArenaEnv], object]) -> None:
        """Play an episode of the scenario; ``take`` takes its actions, from a reset on."""
        with open_live_game(scenario, self._opened()) as (game, display):
            env = ArenaEnv(game, scenario)
            started_over(partial(take, env), self._note)
            picture = without_chat(display.grab(), seen_gui_scale(game.connection.screen))
            taken = game.log.summary()
        lines = (
            f"{len(env.placed)} blocks, {len(env.placed & scenario.design)} of the design's {scenario.blocks}",
            f"{taken['actions']} actions, each seen to be done; {taken['action_s']['p50']} s each (median)",
            f"{taken['share']}; {taken['corrections'] + taken['second_clicks']} moves and clicks repeated",
        )
        shown = (ReportPicture("What was built", picture),)
        self._results.append(StepResult(self.steps[-1].step, Profile(), lines, taken["actions"], shown))

    def put_back(self) -> None:
        """Put back what stood where the arena was built."""
        undone = partial(undo_built_arena, self._profile, context_opener(self._opened(), _agrees))
        self._results.append(replace(started_over(undone, self._note, TRIES)[0], step="undo"))

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """Do nothing: they are this run's own."""

    def begin(self, name: str, number: int, of: int) -> None:  # noqa: ARG002 - the protocol's
        """Show the step's title; with the first one, a calibration begins anew."""
        if number == 1:
            self._results.clear()
        self._say(TITLES[name])

    def end(self, result: StepResult, seconds: float) -> None:
        """Keep what the step found."""
        self._results.append(replace(result, lines=(f"took {seconds:.1f} s", *result.lines)))

    def skip(self, reason: str, seconds: float) -> None:
        """Keep why the step is left out."""
        self._note(f"left out after {seconds:.1f} s: {reason}")

    def pack(self) -> Path:
        """Write the page and the file to send; return the file. RecordingError or OSError if that can't be."""
        profile, text = self._results[-1].profile if self._results else Profile(), None
        if self._profile.is_file():
            profile, text = load_profile(self._profile), self._profile.read_text("utf-8")
        version, findings = importlib.metadata.version("mc-nested"), self._findings()
        report = CalibrationReport(self._folder.name, profile, text or "", findings, version, what="Try-it")
        page, steps = report_html(report, self._names), json.dumps([vars(step) for step in self.steps], indent=1)
        (self._folder / "report.html").write_text(page, "utf-8")
        kept = {f"{each.name}.mcap": each for each in sorted(self._recordings.glob("*")) if _holds_calls(each)}
        out, texts = self._folder / f"{self._folder.name}.zip", {"report.html": page, "steps.json": steps}
        write_bug_report(out, self._checks, text, kept, WHOLE_S, self._names, texts)
        return out

    def _findings(self) -> Findings:
        today, tried = datetime.date.today().isoformat(), tuple(map(str, self.steps))
        found = [StepFindings(each.step, today, each.lines, each.samples, each.pictures) for each in self._results]
        checks = tuple(CheckFinding(**vars(check)) for check in self._checks)
        return Findings((StepFindings("try-it", today, tried, 0), *found), checks, today)


def _holds_calls(recording: Path) -> bool:
    """Return whether anything was recorded: the window may not have opened."""
    with suppress(McNestedError):
        return bool(overview_of(recording).calls)
    return False


def _agrees(question: str) -> bool:
    """Answer what a calibration asks: yes to building what can be undone, no to leaving the world for the titles.

    The list of worlds is nobody else's business. UserError where what stands there can't be copied.
    """
    if NO_COPY in question:
        raise UserError("what stands here can't be copied, so nothing was built: stand elsewhere, and try it again")
    return question != QUESTION


def forty_actions() -> Scenario:
    """Return a scenario that ends after forty actions, with a block for each."""
    return replace(load_scenario("house"), name="forty", step_limit=40)


def take_random_actions(env: ArenaEnv) -> None:
    """Take actions until the episode ends: drawn, always the same, of those that the rules don't void."""
    rng, (seen, _), is_over = np.random.default_rng(SEED), env.reset(), False
    while not is_over:
        action = int(rng.integers(len(Action)))
        expected = env.expected(action)[0]
        if np.array_equal(expected, seen):
            continue
        seen, _, terminated, truncated, _ = env.step(action)
        is_over = terminated or truncated
        if not np.array_equal(seen, expected):
            raise NotConfirmedError(
                f"{Action(action).name} should lead to {expected.tolist()}, and led to {seen.tolist()}"
            )
