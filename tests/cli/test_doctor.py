"""``mc-nested doctor``: its table or JSON, its exit code, and the files that ``--fix`` writes."""

import json
import sys
from functools import partial
from pathlib import Path

import pytest

from calibration.doctor.check import Check, CheckName, Status
from calibration.doctor.examination import Examination, examine
from calibration.installation.folders import System
from mc_nested.cli import doctor
from mc_nested.errors import DesktopError
from mc_nested.live.profile.tables import Profile
from tests.cli.running import run


@pytest.fixture
def bare(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a home without a desktop, and nothing in it."""

    def no_session() -> str:
        raise DesktopError("no display (DISPLAY is not set): run this in the desktop session that shows the game")

    system = System("linux", tmp_path, {})
    monkeypatch.setattr(doctor, "examine", partial(examine, session=no_session, processes=list))
    monkeypatch.setattr(System, "here", classmethod(lambda _: system))
    return tmp_path


def with_rows(monkeypatch: pytest.MonkeyPatch, *statuses: Status) -> None:
    """Make the doctor find rows of these statuses, over and over."""
    checks = [Check(name, statuses[i % len(statuses)], "found " * 30, "do " * 30) for i, name in enumerate(CheckName)]
    found = Examination(checks, Profile(), None, None, None, None)
    monkeypatch.setattr(doctor, "examine", lambda *_args, **_more: found)


def test_json_is_one_object_of_all_rows_and_nothing_else(bare: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("doctor", "--json", "--profile", bare / "none.toml") == 1
    printed = json.loads(capsys.readouterr().out)
    assert list(printed) == ["checks"]
    assert [check["name"] for check in printed["checks"]] == list(CheckName)
    assert all(list(check) == ["name", "status", "detail", "fix"] for check in printed["checks"])
    assert {check["status"] for check in printed["checks"]} == {"fail", "skip"}


@pytest.mark.parametrize(
    ("statuses", "code"), [(("pass",), 0), (("pass", "warn", "skip"), 0), (("pass", "fail"), 1), (("fail",), 1)]
)
def test_the_exit_code_says_whether_a_row_fails(
    statuses: tuple[Status, ...], code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with_rows(monkeypatch, *statuses)
    for words in ((), ("--json",), ("--fix",)):
        assert run("doctor", *words) == code
        assert capsys.readouterr().out


def test_the_table_fits_a_hundred_columns_and_names_every_row(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with_rows(monkeypatch, "pass", "warn", "fail", "skip")
    run("doctor")
    lines = capsys.readouterr().out.splitlines()
    assert max(len(line) for line in lines) <= 100
    assert all(any(line.startswith(name) for line in lines) for name in CheckName)
    assert lines[-1] == "8 pass, 8 warn, 8 fail, 7 skip"


def test_fix_repairs_options_txt_and_then_prints_the_new_rows_as_json_alone(
    bare: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = bare / ".minecraft" / "options.txt"
    options.parent.mkdir()
    options.write_text("lang:en_us\nautoJump:true\n", "utf-8")
    assert run("doctor", "--json", "--fix", "--profile", bare / "none.toml") == 1  # there is still no desktop
    printed = capsys.readouterr()
    assert options.read_text("utf-8") == "lang:en_us\nautoJump:false\n"
    assert "autoJump true -> false" in printed.err
    rows = {check["name"]: check["status"] for check in json.loads(printed.out)["checks"]}
    assert rows["autoJump"] == "pass"


def test_doctor_stopped_by_ctrl_c_exits_with_130_and_prints_no_rows(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stopped(*_args: object, **_more: object) -> Examination:
        raise KeyboardInterrupt

    monkeypatch.setattr(doctor, "examine", stopped)
    assert run("doctor", "--json") == 130
    assert capsys.readouterr().out == ""


if sys.platform.startswith("linux"):

    def test_on_a_computer_without_a_desktop_every_row_is_printed(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        for name in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_SESSION_TYPE", "XDG_DATA_HOME", "XDG_CONFIG_HOME"):
            monkeypatch.delenv(name, raising=False)
        monkeypatch.setenv("HOME", str(tmp_path))
        assert run("doctor", "--json") == 1
        rows = {check["name"]: check for check in json.loads(capsys.readouterr().out)["checks"]}
        assert tuple(rows) == tuple(CheckName)
        assert rows["session"]["status"] == "fail"
        assert "no display" in rows["session"]["detail"]
        assert list(tmp_path.rglob("*")) == []
