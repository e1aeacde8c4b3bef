"""The guided run on virtual clients writes a profile, and writes nothing if anything goes wrong.

The runner of the steps: what each step gets, what ends the run, and which steps are skipped.
"""

import contextlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from calibration.arena.build import build_arena
from calibration.arena.undo import undo_built_arena
from calibration.calibrate_all import (
    GATES,
    CalibrationResult,
    CalibrationStep,
    RunResult,
    StepFunction,
    calibrate_all,
    registered_steps,
    run_steps,
)
from calibration.context import CalibrationContext, ReportPicture, StepResult
from calibration.doctor.check import Check, CheckName
from calibration.report.findings import findings_folder, load_findings
from mc_nested.errors import (
    DesktopError,
    LiveError,
    McNestedError,
    NotConfirmedError,
    NotInFrontError,
    ProfileError,
    StoppedError,
    UserError,
)
from mc_nested.live.profile.store import earlier_path, load_profile, save_profile
from mc_nested.live.profile.tables import CalibratedTable, GameVersion, KeysTable, Profile, ScreenTable
from mc_nested.live.vision.chat_region import without_chat
from scripts.benches.calibration import context_opener_for, doctor_for, write_font
from sim.client.client import VirtualClient
from tests.calibration.contexts import SPANISH, context_over, started

DAY = "2026-11-21"


class ProgressLog:
    """Notes which steps began and were skipped."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.passed: list[str] = []
        self.rows: Sequence[Check] = ()

    def doctor_done(self, checks: Sequence[Check]) -> None:
        self.rows = checks

    def begin(self, name: str, number: int, of: int) -> None:
        self.begun.append(f"{name} {number}/{of}")

    def end(self, result: StepResult, seconds: float) -> None:
        assert result
        assert seconds >= 0

    def skip(self, reason: str, seconds: float) -> None:
        assert seconds >= 0
        self.passed.append(reason)


ALL_PASS = [Check(name, "pass", "") for name in CheckName]


def swapped(context: CalibrationContext, profile: Profile) -> StepResult:
    frame = context.devices.display.grab()
    keys = KeysTable(left="d", right="a")
    return StepResult(
        "walk", profile.model_copy(update={"keys": keys}), ("swapped",), 8, (ReportPicture("seen", frame),)
    )


def broken(context: CalibrationContext, _profile: Profile) -> StepResult:
    context.controller.confirm_screen("world")
    context.controller.press(context.devices.clock.now() + 2, "w")
    raise NotConfirmedError("it did not go as it should")


def stopped(context: CalibrationContext, profile: Profile) -> StepResult:
    with pytest.raises(NotConfirmedError):
        broken(context, profile)
    raise KeyboardInterrupt


@pytest.fixture
def client() -> VirtualClient:
    return started(VirtualClient(pitch=40.0))


@pytest.fixture
def profile(tmp_path: Path) -> Path:
    """Return a profile that was there before."""
    path = tmp_path / "mine.toml"
    save_profile(Profile(screen=ScreenTable(font=str(write_font(tmp_path)))), path)
    return path


def run(
    client: VirtualClient,
    profile: Path,
    *steps: CalibrationStep,
    progress: ProgressLog | None = None,
    rows: Sequence[Check] = ALL_PASS,
) -> CalibrationResult:
    return calibrate_all(
        str(profile), context_opener_for(client), lambda _: rows, steps, progress or ProgressLog(), DAY
    )


def test_profile_is_written_with_the_version_window_and_scale_it_was_calibrated_on(
    client: VirtualClient, profile: Path
) -> None:
    before = profile.read_bytes()
    result = run(client, profile, CalibrationStep("walk", swapped))
    written = load_profile(profile)
    assert written == result.run.profile
    assert written.keys.left == "d"
    assert written.game.version == "1.20.1"
    assert written.calibrated == CalibratedTable(
        date=DAY, version="1.20.1", window=(854, 480), gui_scale=2, debug_scale=2, samples={"walk": 8}
    )
    assert earlier_path(profile).read_bytes() == before


def test_findings_and_checks_are_saved_beside_the_profile(client: VirtualClient, profile: Path) -> None:
    run(client, profile, CalibrationStep("walk", swapped))
    kept = load_findings(profile)
    assert [(step.step, step.lines, step.date) for step in kept.steps] == [("walk", ("swapped",), DAY)]
    assert [check.name for check in kept.checks] == list(CheckName)
    assert kept.steps[0].pictures[0].frame.shape == (480, 854, 3)


@pytest.mark.parametrize("row", sorted(GATES))
def test_failing_gate_row_ends_the_run_before_any_step_with_its_fix(
    row: CheckName, client: VirtualClient, profile: Path
) -> None:
    before = profile.read_bytes()
    rows = [
        Check(row, "fail", "this is wrong", "do that") if name == row else Check(name, "pass", "") for name in CheckName
    ]
    progress = ProgressLog()
    with pytest.raises(DesktopError, match=f"^{row}: this is wrong: do that$"):
        run(client, profile, CalibrationStep("walk", swapped), progress=progress, rows=rows)
    assert progress.rows == (), "what fails is said once, by the error"
    assert progress.begun == []
    assert profile.read_bytes() == before


def test_every_gate_is_the_name_of_a_doctor_row() -> None:
    assert set(CheckName) >= GATES


def test_failing_rows_that_are_not_gates_do_not_end_the_run(client: VirtualClient, profile: Path) -> None:
    rows = [Check(name, "pass" if name in GATES else "fail", "") for name in CheckName]
    run(client, profile, CalibrationStep("walk", swapped), rows=rows)
    assert load_profile(profile).calibrated is not None


@pytest.mark.parametrize("last", [broken, stopped])
def test_run_that_fails_or_is_interrupted_leaves_the_profile_unchanged_and_no_key_down(
    last: object, client: VirtualClient, profile: Path
) -> None:
    before = profile.read_bytes()
    assert callable(last)
    with pytest.raises((LiveError, KeyboardInterrupt)):
        run(client, profile, CalibrationStep("walk", swapped), CalibrationStep("proof", last))
    assert profile.read_bytes() == before
    assert not findings_folder(profile).exists()
    assert not earlier_path(profile).exists()
    assert not client.window.down


def test_shared_game_is_refused_before_any_step(
    client: VirtualClient, profile: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")
    progress = ProgressLog()
    with pytest.raises(DesktopError, match=r"others may be playing there.*--server-allowed"):
        run(client, profile, CalibrationStep("walk", swapped), progress=progress)
    assert progress.begun == []
    assert client.built == {}


@pytest.mark.parametrize("name", ["dir.toml", "file/mine.toml"])
def test_unwritable_profile_path_is_reported_before_the_doctor_looks(
    name: str, client: VirtualClient, tmp_path: Path
) -> None:
    (tmp_path / "dir.toml").mkdir()
    (tmp_path / "file").write_text("", "utf-8")
    progress = ProgressLog()
    with pytest.raises(ProfileError, match="--profile"):
        run(client, tmp_path / name, CalibrationStep("walk", swapped), progress=progress)
    assert progress.rows == (), "not even the doctor has looked"
    assert progress.begun == []


def test_findings_that_cannot_be_saved_do_not_end_the_run(client: VirtualClient, profile: Path) -> None:
    findings_folder(profile).write_text("no folder", "utf-8")
    run(client, profile, CalibrationStep("walk", swapped))
    assert load_profile(profile).keys.left == "d"


@pytest.mark.parametrize("last", [broken, stopped])
def test_run_that_ends_after_building_the_arena_can_be_undone(last: StepFunction, tmp_path: Path) -> None:
    client = VirtualClient()
    client.realm.world.put((3, 64, 6), "stone")
    before, file = client.built, tmp_path / "new.toml"
    arena = CalibrationStep("arena", partial(build_arena, path=file))
    font = Profile(screen=ScreenTable(font=str(write_font(tmp_path))))
    with pytest.raises((LiveError, KeyboardInterrupt)):
        run(
            client,
            file,
            CalibrationStep("font", lambda _context, _profile: StepResult("font", font, (), 0)),
            arena,
            CalibrationStep("walk", last),
        )
    assert not file.exists()
    assert client.built != before
    undo_built_arena(str(file), context_opener_for(client))
    assert client.built == before
    assert list(tmp_path.glob("new*")) == []


def test_a_window_resized_midway_is_a_one_line_error(client: VirtualClient, profile: Path) -> None:
    def resized(context: CalibrationContext, profile: Profile) -> StepResult:
        client.resize((1280, 720))
        return swapped(context, profile)

    before = profile.read_bytes()
    with pytest.raises(DesktopError, match="walk: the window was 854 x 480 pixels and is 1280 x 720"):
        run(client, profile, CalibrationStep("walk", resized))
    assert profile.read_bytes() == before


def test_skipped_step_has_no_samples_in_the_profile(client: VirtualClient, profile: Path) -> None:
    progress = ProgressLog()
    result = run(
        client,
        profile,
        CalibrationStep("walk", swapped),
        CalibrationStep("clicks", broken, is_needed=False),
        progress=progress,
    )
    assert progress.begun == ["walk 1/2", "clicks 2/2"]
    assert progress.passed == ["it did not go as it should"]
    assert result.run.skipped == {"clicks": "it did not go as it should"}
    assert result.run.profile.calibrated is not None
    assert result.run.profile.calibrated.samples == {"walk": 8}


def test_menus_in_another_language_skip_the_click_points_with_a_reason(profile: Path) -> None:
    client = started(VirtualClient(words=SPANISH, pitch=40.0))
    clicks = next(step for step in registered_steps() if step.name == "clicks")
    result = run(client, profile, CalibrationStep("walk", swapped), clicks)
    assert result.run.skipped["clicks"].startswith("no button was found; the Game Menu: no English label")
    assert load_profile(profile).points == {}
    assert client.game.screen == "world"


def all_of_it(client: VirtualClient, folder: Path) -> CalibrationResult:
    font = write_font(folder)
    examined = doctor_for(client, folder)
    return calibrate_all(
        str(folder / "new.toml"), context_opener_for(client), examined, registered_steps(font), ProgressLog(), DAY
    )


@pytest.mark.slow
def test_whole_calibration_runs_unattended_in_less_than_five_minutes(tmp_path: Path) -> None:
    client = VirtualClient(seed=5, version="1.21.9", size=(1000, 700), scale=0, pitch=35.0, yaw=-86.0, swaps_sides=True)
    began = client.clock.now()
    result = all_of_it(client, tmp_path)
    assert client.clock.now() - began < 300
    assert result.run.skipped == {}
    written = load_profile(result.path)
    assert (written.keys.left, written.keys.right) == ("d", "a")
    assert written.marked_arena().facing == "east"
    assert set(written.points) == {
        *("back_to_game", "save_and_quit_to_title", "singleplayer", "world", "play_selected_world")
    }
    assert [step.step for step in load_findings(result.path).steps] == [
        *("font", "arena", "walk", "clicks", "cross-check", "proof")
    ]
    assert not [check for check in result.checks if check.status == "fail"]
    pictures = [picture.frame for found in result.run.results for picture in found.pictures]
    whole_window = [frame for frame in pictures if frame.shape[:2] == (700, 1000)]
    assert len(whole_window) == 3
    for frame in whole_window:
        assert np.array_equal(frame, without_chat(frame, client.scale)), "nothing that was said is on a picture"
    assert not client.window.down
    assert not client.window.strays


class Troublemaker(ProgressLog):
    """Lets something happen soon after a step has begun."""

    def __init__(self, client: VirtualClient, step: str, what: str) -> None:
        super().__init__()
        self._client, self._step, self._what = client, step, what

    def begin(self, name: str, number: int, of: int) -> None:
        super().begin(name, number, of)
        if name == self._step:
            self._client.clock.call_at(self._client.clock.now() + 0.15, self._happen)

    def _happen(self) -> None:
        if self._what == "Ctrl+C":
            raise KeyboardInterrupt
        if self._what == "another window":
            self._client.set_front(is_in_front=False)
        else:
            self._client.resize((1024, 768))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("step", "what"),
    [
        *(("font", "Ctrl+C"), ("arena", "Ctrl+C"), ("walk", "Ctrl+C"), ("clicks", "Ctrl+C"), ("proof", "Ctrl+C")),
        *(
            ("walk", "another window"),
            ("proof", "another window"),
            ("font", "another size"),
            ("clicks", "another size"),
        ),
    ],
)
def test_ctrl_c_another_window_or_a_resize_midway_writes_nothing_and_leaves_no_key_down(
    step: str, what: str, tmp_path: Path
) -> None:
    client = VirtualClient(seed=7, pitch=35.0)
    progress = Troublemaker(client, step, what)
    steps, examined = registered_steps(write_font(tmp_path)), doctor_for(client, tmp_path)
    with pytest.raises((McNestedError, KeyboardInterrupt)) as ended:
        calibrate_all(str(tmp_path / "new.toml"), context_opener_for(client), examined, steps, progress, DAY)
    assert "\n" not in str(ended.value)
    assert progress.begun[-1].startswith(step), "it ended where that happened"
    assert list(tmp_path.glob("new*")) == []
    assert not client.window.down
    assert not client.window.strays


@dataclass
class StepLog:
    """Notes the progress of the run."""

    events: list[object] = field(default_factory=list)

    def doctor_done(self, checks: Sequence[Check]) -> None:
        self.events.append(checks)

    def begin(self, name: str, number: int, of: int) -> None:
        self.events.append((name, number, of))

    def end(self, result: StepResult, seconds: float) -> None:
        self.events.append((result.lines, round(seconds, 6)))

    def skip(self, reason: str, seconds: float) -> None:
        self.events.append((reason, round(seconds, 6)))


class Room:
    """A virtual client with a calibration context, and the profiles with which the run recovered."""

    def __init__(self) -> None:
        self.client = VirtualClient()
        self.progress = StepLog()
        self.recoveries: list[Profile] = []
        self.context = context_over(self.client)

    def run(self, *steps: CalibrationStep, profile: Profile | None = None) -> RunResult:
        return run_steps(steps, self.context, profile or Profile(), self.progress, self.recoveries.append)


def sets(**tables: object) -> StepFunction:
    """Make a step that takes a second and finds these tables."""

    def run(context: CalibrationContext, profile: Profile) -> StepResult:
        context.devices.clock.sleep_until(context.devices.clock.now() + 1)
        return StepResult("+".join(tables), profile.model_copy(update=tables), (f"found {', '.join(tables)}",), 1)

    return run


def fails(error: BaseException) -> StepFunction:
    """Make a step that fails after half a second, a key still down."""

    def run(context: CalibrationContext, _profile: Profile) -> StepResult:
        context.controller.confirm_screen("world")
        context.controller.press(context.devices.clock.now() + 2, "w")
        context.devices.clock.sleep_until(context.devices.clock.now() + 0.5)
        raise error

    return run


OLD = GameVersion(version="1.12.2")
SWAPPED = KeysTable(left="d", right="a")


def test_each_step_gets_the_profile_that_the_step_before_returned() -> None:
    room = Room()
    seen: list[Profile] = []

    def last(_context: CalibrationContext, profile: Profile) -> StepResult:
        seen.append(profile)
        return StepResult("last", profile, (), 0)

    result = room.run(
        CalibrationStep("game", sets(game=OLD)),
        CalibrationStep("keys", sets(keys=SWAPPED)),
        CalibrationStep("last", last),
    )
    assert result.profile == seen[0] == Profile(game=OLD, keys=SWAPPED)
    assert [each.step for each in result.results] == ["game", "keys", "last"]
    assert result.skipped == {}
    assert room.progress.events == [
        ("game", 1, 3),
        (("found game",), 1.0),
        ("keys", 2, 3),
        (("found keys",), 1.0),
        ("last", 3, 3),
        ((), 0.0),
    ]


@pytest.mark.parametrize("error", [NotConfirmedError("no"), ProfileError("no")])
def test_needed_step_that_fails_ends_the_run_and_is_named_in_the_error(error: McNestedError) -> None:
    room = Room()
    with pytest.raises(type(error), match=r"^walk: no \(the profile is as it was\)$"):
        room.run(CalibrationStep("walk", fails(error)), CalibrationStep("never", fails(AssertionError())))
    assert room.recoveries == []


@pytest.mark.parametrize("error", [LiveError("no such button"), UserError("no such button")])
def test_failed_optional_step_is_skipped_and_the_run_recovers_the_world(error: McNestedError) -> None:
    room = Room()
    result = room.run(
        CalibrationStep("game", sets(game=OLD)),
        CalibrationStep("clicks", fails(error), is_needed=False),
        CalibrationStep("keys", sets(keys=SWAPPED)),
    )
    assert result.profile == Profile(game=OLD, keys=SWAPPED)
    assert [each.step for each in result.results] == ["game", "keys"]
    assert result.skipped == {"clicks": "no such button"}
    assert ("no such button", 0.5) in room.progress.events
    assert room.recoveries == [Profile(game=OLD)]


@pytest.mark.parametrize("error", [NotInFrontError("behind"), StoppedError("the panic key was pressed")])
def test_losing_the_game_ends_the_run_even_in_an_optional_step(error: McNestedError) -> None:
    with pytest.raises(type(error), match="clicks: "):
        Room().run(
            CalibrationStep("clicks", fails(error), is_needed=False), CalibrationStep("never", fails(AssertionError()))
        )


@pytest.mark.parametrize("is_needed", [True, False])
@pytest.mark.parametrize("error", [NotConfirmedError("no"), KeyboardInterrupt(), StoppedError("stop")])
def test_no_key_stays_down_however_a_step_ends(error: BaseException, is_needed: bool) -> None:
    room = Room()
    with contextlib.suppress(LiveError, KeyboardInterrupt):
        room.run(CalibrationStep("walk", fails(error), is_needed=is_needed))
    assert not room.client.window.down
