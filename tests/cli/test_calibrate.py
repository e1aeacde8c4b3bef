"""``mc-nested calibrate all`` and ``undo``: their words step by step, their exit codes, and the report."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from calibration.arena.undo import write_copy_note
from calibration.calibrate_all import CalibrationStep
from calibration.context import CalibrationContext, OpenContext, StepResult
from calibration.doctor.check import Check, CheckName
from mc_nested.cli import calibrate
from mc_nested.cli.output import json_fields
from mc_nested.errors import LiveError
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import GameVersion, Profile, ScreenTable
from mc_nested.live.session import Opening
from scripts.benches.calibration import context_opener_for, write_font
from sim.client.client import VirtualClient
from tests.calibration.contexts import started
from tests.cli.running import run


@pytest.fixture
def client() -> VirtualClient:
    return started(VirtualClient(pitch=40.0))


def code_of(profile: Path, *options: str) -> int:
    return run("calibrate", "all", "--yes", "--profile", profile, *options)


def set_up(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, *steps: CalibrationStep, failing: str | None = None
) -> None:
    """Make that client's window the only one of the desktop, and these the steps."""
    rows = [
        Check(name, "fail", "it is wrong", "mend it") if name == failing else Check(name, "pass", "")
        for name in CheckName
    ]
    monkeypatch.setattr(calibrate, "context_opener", lambda *_: context_opener_for(client))
    monkeypatch.setattr(calibrate, "registered_steps", lambda *_, **__: list(steps))
    monkeypatch.setattr(calibrate, "examined", lambda *_: SimpleNamespace(checks=rows))


def with_font(folder: Path) -> CalibrationStep:
    font = str(write_font(folder))

    def step(context: CalibrationContext, profile: Profile) -> StepResult:
        context.devices.clock.sleep_until(context.devices.clock.now() + 4)
        return StepResult("font", profile.model_copy(update={"screen": ScreenTable(font=font)}), ("GUI scale 2",), 3)

    return CalibrationStep("font", step)


def failing(error: BaseException, *, is_needed: bool = True) -> CalibrationStep:
    def step(_context: CalibrationContext, _profile: Profile) -> StepResult:
        raise error

    return CalibrationStep("clicks", step, is_needed)


def test_guided_run_prints_each_steps_findings_and_makes_the_report(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    profile = tmp_path / "mine.toml"
    nothing = failing(LiveError("no button 'Back to Game' is to be seen"), is_needed=False)
    set_up(monkeypatch, client, with_font(tmp_path), nothing, failing="autoJump")
    assert code_of(profile) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[:6] == [
        f"doctor: {len(CheckName) - 1} pass, 1 fail",
        "    fail: autoJump: it is wrong; mend it",
        "1/2 Font and screen",
        "    GUI scale 2",
        "    [4 s, 4 s in all]",
        "2/2 Click points",
    ]
    assert "    warning: no button 'Back to Game' is to be seen; the run goes on without it" in said
    assert "calibrated in 4 s, without: Click points" in said
    assert f"profile: {profile}" in said
    assert "GUI scale 2" in (tmp_path / "mine-calibration.html").read_text("utf-8")


def test_json_gives_each_steps_findings_and_the_steps_left_out(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    nothing = failing(LiveError("no button is to be seen"), is_needed=False)
    set_up(monkeypatch, client, with_font(tmp_path), nothing)
    assert code_of(tmp_path / "mine.toml", "--json") == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert found == {
        "profile": str(tmp_path / "mine.toml"),
        "seconds": 4.0,
        "steps": [{"step": "font", "lines": ["GUI scale 2"], "samples": 3}],
        "left_out": {"clicks": "no button is to be seen"},
        "report": str(tmp_path / "mine-calibration.html"),
    }
    assert found.keys() == json_fields(calibrate.calibrate_all).keys()
    assert "1/2 Font and screen" in printed.err


def test_quiet_prints_only_the_result(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up(monkeypatch, client, with_font(tmp_path))
    assert code_of(tmp_path / "mine.toml", "--quiet") == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines()[:2] == ["calibrated in 4 s", f"profile: {tmp_path / 'mine.toml'}"]
    assert printed.err == ""


@pytest.mark.parametrize("words", [[], ["--quiet"], ["--json"]])
def test_instructions_to_the_player_are_printed_even_with_quiet_or_json(
    words: list[str],
    monkeypatch: pytest.MonkeyPatch,
    client: VirtualClient,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def opener(opening: Opening, _ask: object) -> OpenContext:
        opening.say("Switch to the game.")
        return context_opener_for(client)

    set_up(monkeypatch, client, with_font(tmp_path))
    monkeypatch.setattr(calibrate, "context_opener", opener)
    assert code_of(tmp_path / "mine.toml", *words) == 0
    printed = capsys.readouterr()
    assert "Switch to the game.\n" in (printed.err if words else printed.out)


def test_failing_step_is_a_one_line_error_and_writes_nothing(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up(monkeypatch, client, with_font(tmp_path), failing(LiveError("no button is to be seen")))
    assert code_of(tmp_path / "mine.toml") == 2
    error = capsys.readouterr().err
    assert error == "mc-nested: clicks: no button is to be seen (the profile is as it was)\n"
    assert list(tmp_path.glob("mine*")) == []


def test_a_run_that_fails_once_the_arena_is_built_says_how_to_undo_it(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    set_up(monkeypatch, client, with_font(tmp_path), failing(LiveError("no button is to be seen")))
    write_copy_note(Profile(), file)
    assert code_of(file) == 2
    assert capsys.readouterr().err.endswith(f"mc-nested calibrate arena --undo --profile {file}\n")


def test_ctrl_c_ends_the_run_in_one_line_and_nothing_is_written(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up(monkeypatch, client, with_font(tmp_path), failing(KeyboardInterrupt()))
    assert code_of(tmp_path / "mine.toml") == 130
    assert capsys.readouterr().err == "mc-nested: stopped\n"
    assert list(tmp_path.glob("mine*")) == []


def test_failing_gate_row_of_the_doctor_ends_the_run_with_its_fix(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up(monkeypatch, client, with_font(tmp_path), failing="in front")
    assert code_of(tmp_path / "mine.toml") == 2
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "mc-nested: in front: it is wrong: mend it\n")


def test_cell_outside_the_arena_is_refused_in_one_line_and_nothing_is_written(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(calibrate, "context_opener", lambda *_: context_opener_for(client))
    assert code_of(tmp_path / "mine.toml", "--standing", "-1", "0") == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err == "mc-nested: cell (-1, 0) lies outside the arena: choose 0 to 14 for x and y\n"
    assert list(tmp_path.iterdir()) == []


def test_options_reach_the_steps_and_server_allowed_reaches_the_game(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path
) -> None:
    given: dict[str, object] = {}
    allowed: list[bool] = []

    def opener(opening: Opening, _ask: object) -> OpenContext:
        allowed.append(opening.is_server_allowed)
        return context_opener_for(client)

    set_up(monkeypatch, client)
    monkeypatch.setattr(calibrate, "context_opener", opener)

    def steps(*_: object, **options: object) -> list[CalibrationStep]:
        given.update(options)
        return [with_font(tmp_path)]

    monkeypatch.setattr(calibrate, "registered_steps", steps)
    assert code_of(tmp_path / "mine.toml") == 0
    assert given == {"size": 15, "standing": None, "path": tmp_path / "mine.toml"}
    assert code_of(tmp_path / "mine.toml", "--size", "20", "--standing", "3", "4") == 0
    assert given == {"size": 20, "standing": (3, 4), "path": tmp_path / "mine.toml"}
    assert code_of(tmp_path / "mine.toml", "--server-allowed") == 0
    assert allowed == [False, False, True]


def test_a_report_that_can_not_be_made_is_a_warning(
    monkeypatch: pytest.MonkeyPatch, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    set_up(monkeypatch, client, with_font(tmp_path))
    (tmp_path / "mine-calibration").mkdir()
    (tmp_path / "mine-calibration" / "found.json").write_text("broken", "utf-8")
    assert code_of(tmp_path / "mine.toml") == 0
    assert "warning: no report: " in capsys.readouterr().out
    assert (tmp_path / "mine.toml").is_file()


@pytest.mark.parametrize("verb", ["all", "undo", "report", "walk", "font", "clicks"])
def test_an_empty_profile_name_is_refused(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("calibrate", verb, "--profile", "") == 2
    assert capsys.readouterr().err == "mc-nested: '' names no profile: give a name, or a file that ends in .toml\n"


def test_undo_puts_the_earlier_profile_back_and_a_second_time_the_later_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    earlier, later = Profile(), Profile(game=GameVersion(version="1.12.2"))
    save_profile(earlier, file)
    save_profile(later, file)
    for profile in (earlier, later):
        assert run("calibrate", "undo", "--profile", file) == 0
        assert load_profile(file) == profile
        assert capsys.readouterr().out == f"{file} is as it was before\n"


def test_undo_says_where_a_file_that_can_not_be_read_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(Profile(), file)
    save_profile(Profile(points={"other": (0.5, 0.5)}), file)
    file.write_text("[walking]\n", "utf-8")
    assert run("calibrate", "undo", "--profile", file) == 0
    said = f"{file} is as it was before\nwhat stood there is no profile that can be read: it is kept in {file}.broken\n"
    assert capsys.readouterr().out == said
