"""``mc-nested try-it``: whatever happens, there is one file of it, without names, and one line that says so."""

import json
import re
import zipfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import pytest
import typer

from calibration import try_it as steps
from calibration.arena.build import NO_COPY
from calibration.clicks.find import QUESTION
from calibration.context import StepResult
from calibration.doctor.check import Check, CheckName
from calibration.report.privacy import Names
from calibration.try_it import TryIt, _agrees, forty_actions, take_random_actions
from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli import try_it
from mc_nested.errors import DesktopError, LiveError, NotConfirmedError, StoppedError, UserError
from mc_nested.live.devices import Devices, Frame, Region
from mc_nested.live.input.stops import KEY_REASON, Stop
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.recording_file import TimedCall, read_recording
from mc_nested.live.session import Opening
from scripts.benches.calibration import doctor_for, write_font
from sim.client.client import VirtualClient
from sim.grid import GridGame
from tests.calibration.contexts import started
from tests.cli.running import run

STEPS = ("question", "doctor", "calibration", "actions", "line", "undo")


@dataclass
class Volunteer:
    """A person at a virtual client, in a folder named after them, who says yes to everything."""

    folder: Path
    client: VirtualClient
    stop: list[Stop] = field(default_factory=list)

    @property
    def out(self) -> Path:
        return self.folder / "out"

    def tries(self) -> int:
        return run("try-it", "--yes", "--out", self.out, "--font", self.folder / "ascii.png")

    def steps(self) -> list[dict[str, object]]:
        """Return the steps in the file, which is there."""
        with zipfile.ZipFile(self.out / "out.zip") as file:
            steps: list[dict[str, object]] = json.loads(file.read("steps.json"))
        return steps

    def failed(self) -> list[object]:
        return [step["step"] for step in self.steps() if step["failed_by"]]


def at_the_client(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Volunteer:
    folder.mkdir()
    volunteer = Volunteer(folder, started(VirtualClient(pitch=40.0)))

    @contextmanager
    def open_devices(_title: str) -> Iterator[Devices]:
        yield volunteer.client.devices

    def open_panic_switch(_key: str, stop: Stop) -> AbstractContextManager[None]:
        volunteer.stop.append(stop)
        return nullcontext()

    def opening_of(*_: object) -> Opening:
        return Opening("", print, open_devices=open_devices, open_panic_switch=open_panic_switch)

    write_font(folder)
    monkeypatch.setattr(try_it, "opening_of", opening_of)
    monkeypatch.setattr(
        try_it, "examined", lambda name, _font: SimpleNamespace(checks=doctor_for(volunteer.client, folder)(name))
    )
    monkeypatch.setattr(try_it, "names_here", lambda: Names(str(folder), ("ann",)))
    return volunteer


@pytest.fixture
def ann(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Volunteer:
    return at_the_client(tmp_path / "ann", monkeypatch)


def fail_in(step: str, error: BaseException, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every step do nothing, and this one raise."""
    plays = iter(("actions", "line"))

    def does(name: str) -> Callable[..., None]:
        def do(*_: object, **__: object) -> None:
            if (next(plays) if name == "play" else name) == step:
                raise error

        return do

    monkeypatch.setattr(try_it, "_ask", does("question"))
    for method, name in (("examine", "doctor"), ("calibrate", "calibration"), ("play", "play"), ("put_back", "undo")):
        monkeypatch.setattr(TryIt, method, does(name))


ERRORS = (
    LiveError("no block was seen"),
    DesktopError("the window 'Minecraft' has closed: start the game again"),
    ValueError("a mistake of ours"),
    StoppedError("the panic key was pressed"),
    KeyboardInterrupt(),
)


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize("step", STEPS)
def test_a_failure_in_any_step_writes_the_file_and_says_in_one_line_what_failed_and_where_the_file_is(
    step: str,
    error: BaseException,
    ann: Volunteer,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    fail_in(step, error, monkeypatch)
    assert ann.tries() == (130 if isinstance(error, StoppedError | KeyboardInterrupt) else 2)
    *_, last = capsys.readouterr().err.splitlines()
    assert str(error) in last
    assert f"please send {ann.out / 'out.zip'}" in last
    assert ann.failed() == [step]
    assert [each["step"] for each in ann.steps()] == list(STEPS[: STEPS.index(step) + 1])
    assert type(error).__name__ in str(ann.steps()[-1])


def test_no_agreement_is_a_failure_before_anything_is_pressed(
    ann: Volunteer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(typer, "confirm", lambda _question: False)
    assert run("try-it", "--out", ann.out) == 2
    assert "nothing was pressed or built, since you didn't agree" in capsys.readouterr().err
    assert ann.failed() == ["question"]


def test_a_gate_of_the_doctor_ends_it_and_the_titles_of_other_windows_are_not_in_the_file(
    ann: Volunteer, monkeypatch: pytest.MonkeyPatch
) -> None:
    titles = "no window of the game is open: start the game; windows on this desktop: 'Diary', 'Inbox \"x\"'"
    row = Check(CheckName.WINDOW, "fail", titles, "start the game")
    monkeypatch.setattr(try_it, "examined", lambda *_: SimpleNamespace(checks=[row]))
    assert ann.tries() == 2
    assert ann.failed() == ["doctor"]
    with zipfile.ZipFile(ann.out / "out.zip") as file:
        texts = [file.read(name).decode() for name in file.namelist()]
    assert any("no window of the game is open" in text for text in texts)
    assert not [text for text in texts if "Diary" in text or "Inbox" in text]


def test_a_folder_that_holds_anything_is_refused_and_left_as_it_is(
    ann: Volunteer, capsys: pytest.CaptureFixture[str]
) -> None:
    ann.out.mkdir()
    (ann.out / "mine.txt").write_text("mine")
    assert ann.tries() == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert [path.name for path in ann.out.iterdir()] == ["mine.txt"]


def test_a_full_disk_is_said_beside_what_failed(
    ann: Volunteer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    fail_in("line", LiveError("no block was seen"), monkeypatch)

    def refuses(*_: object) -> None:
        raise OSError("no space left on the disk")

    monkeypatch.setattr(TryIt, "pack", refuses)
    assert ann.tries() == 2
    said = capsys.readouterr().err.splitlines()[-1]
    assert "no block was seen; there is no file to send: no space left on the disk" in said


AFTER_S = 20.0
"""Game time by which the arena is being made, or the walk measured."""


def check_left(ann: Volunteer, capsys: pytest.CaptureFixture[str]) -> None:
    assert ann.client.window.down == set()
    assert ann.failed() == ["calibration"]
    assert "Traceback" not in capsys.readouterr().err
    with zipfile.ZipFile(ann.out / "out.zip") as file:
        assert "1-calibration.mcap" in file.namelist()


def test_ctrl_c_in_a_calibration_leaves_a_file_with_its_recording_and_no_key_down(
    ann: Volunteer, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt() -> None:
        raise KeyboardInterrupt

    ann.client.clock.call_at(ann.client.clock.now() + AFTER_S, interrupt)
    assert ann.tries() == 130
    check_left(ann, capsys)


def test_the_panic_key_leaves_a_file_and_how_to_put_back_what_stood_there(
    ann: Volunteer, capsys: pytest.CaptureFixture[str]
) -> None:
    ann.client.clock.call_at(ann.client.clock.now() + AFTER_S, lambda: ann.stop[-1](KEY_REASON))
    assert ann.tries() == 130
    said = capsys.readouterr().err
    assert KEY_REASON in said
    assert said.splitlines()[-1].count(f"calibrate arena --undo --profile {ann.out / 'profile.toml'}") == 1
    check_left(ann, capsys)


def test_a_window_that_closes_leaves_a_file_and_no_key_down(
    ann: Volunteer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    closes_at, grab = ann.client.clock.now() + AFTER_S, ann.client.display.grab

    def grabbed(region: Region | None = None) -> Frame:
        if ann.client.clock.now() >= closes_at:
            raise DesktopError("the window 'Minecraft 1.20.1' has closed: start the game again")
        return grab(region)

    monkeypatch.setattr(ann.client.display, "grab", grabbed)
    assert ann.tries() == 2
    check_left(ann, capsys)


@pytest.mark.slow
def test_what_stood_there_is_put_back_after_a_failure_that_leaves_the_game(
    ann: Volunteer, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(*_: object) -> None:
        raise NotConfirmedError("no block was seen")

    monkeypatch.setattr(TryIt, "play", fails)
    assert ann.tries() == 2
    said = capsys.readouterr().err.splitlines()[-1]
    assert "Forty actions: no block was seen" in said
    assert "--undo" not in said
    assert ([step["step"] for step in ann.steps()][-1], ann.failed()) == ("undo", ["actions"])
    assert {name for name in ann.client.built.values() if name != "air"} == set()


@pytest.mark.slow
def test_all_steps_are_done_and_the_file_without_names_replays_without_a_difference(
    ann: Volunteer, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ann.client.clipboard.write("mine")
    assert ann.tries() == 0
    assert re.search(rf"done in \d+ s; please send {ann.out / 'out.zip'} \(", capsys.readouterr().out)
    assert ([step["step"] for step in ann.steps()], ann.failed()) == (list(STEPS), [])
    assert load_profile(ann.out / "profile.toml").arena is None
    assert not profile_path("default").exists()
    assert (ann.client.window.down, ann.client.clipboard.read()) == (set(), "mine")
    assert {name for name in ann.client.built.values() if name != "air"} == set()
    with zipfile.ZipFile(ann.out / "out.zip") as file:
        file.extractall(tmp_path / "sent")
    sent = {path.name: path for path in (tmp_path / "sent").iterdir()}
    recordings = ["1-calibration.mcap", "2-actions.mcap", "3-line.mcap", "4-undo.mcap"]
    assert sent.keys() == {"report.html", "steps.json", "doctor.json", "profile.toml", "versions.json", *recordings}
    for name in recordings:
        assert run("replay", sent[name], "--font", ann.folder / "ascii.png", "--json") == 0, capsys.readouterr().out
        calls = [each.call for each in read_recording(sent[name]) if isinstance(each, TimedCall)]
        sent[name].write_text(json.dumps(calls), "utf-8")
    said = capsys.readouterr().out
    assert [json.loads(line)["followed"] for line in said.splitlines()] == [0, 40, 13, 0]
    for name, path in sent.items():
        text = path.read_text("utf-8")
        assert str(ann.folder) not in text, name
        assert not re.search(r"\bann\b", text), name
        assert "New World" not in text, name
    assert "the title and the list of worlds: not visited" in sent["report.html"].read_text("utf-8")


@pytest.mark.parametrize(("failures", "code"), [(1, 0), (2, 2)])
@pytest.mark.parametrize("what", ["calibrate_all", "undo_built_arena"])
def test_a_calibration_and_what_puts_back_are_tried_once_more_after_a_mishap(
    what: str, failures: int, code: int, ann: Volunteer, monkeypatch: pytest.MonkeyPatch
) -> None:
    left, done = iter(range(failures)), (StepResult("arena", Profile(), (), 0), ann.out)

    def lags(*_: object) -> tuple[StepResult, Path]:
        if next(left, None) is not None:
            raise LiveError("it lagged")
        return done

    monkeypatch.setattr(try_it, "_ask", lambda **_: None)
    monkeypatch.setattr(TryIt, "examine", lambda *_: None)
    monkeypatch.setattr(TryIt, "play", lambda *_: None)
    for name in ("calibrate_all", "undo_built_arena"):
        monkeypatch.setattr(steps, name, lags if name == what else lambda *_: done)
    assert ann.tries() == code
    step = next(each for each in ann.steps() if each["problems"])
    assert "it lagged; the episode starts over" in str(step["problems"])
    assert step["step"] == ("calibration" if what == "calibrate_all" else "undo")


class Deaf(GridGame):
    """A game that doesn't hear the third action."""

    heard = 0

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        self.heard += 1
        if self.heard == 3:
            return Outcome((0, 0), None)
        return super().act(action, material, following)


def test_forty_actions_are_the_same_each_time_and_none_is_void() -> None:
    scenario, taken = forty_actions(), []
    for _ in range(2):
        env = ArenaEnv(GridGame(scenario), scenario)
        take_random_actions(env)
        taken.append(env.placed)
        assert not env._running
    assert taken[0] == taken[1]
    assert 5 < len(taken[0]) < 40


def test_an_action_that_leads_elsewhere_is_an_error() -> None:
    scenario = forty_actions()
    with pytest.raises(NotConfirmedError, match=r"should lead to .*, and led to \[0, 0, 40\]"):
        take_random_actions(ArenaEnv(Deaf(scenario), scenario))


def test_a_calibration_may_build_what_can_be_undone_and_does_not_visit_the_list_of_worlds() -> None:
    assert _agrees("Build the arena from (0, 0, 0)?")
    assert not _agrees(QUESTION)
    with pytest.raises(UserError, match="can't be copied, so nothing was built"):
        _agrees(f"Build the arena? {NO_COPY}")


def test_the_line_that_does_not_stand_is_an_error() -> None:
    class Unbuilt(GridGame):
        def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
            return Outcome(super().act(action, material, following).cell, None)

    scenario = load_scenario("line")
    with pytest.raises(NotConfirmedError, match="0 of 11 blocks stand"):
        try_it._build(ArenaEnv(Unbuilt(scenario), scenario))
