"""The command: which verbs and modules it loads, and what becomes of an error."""

import importlib.metadata
import os
import subprocess
import sys
from pathlib import Path

import pytest
import typer

from mc_nested.cli import app as app_module
from mc_nested.cli import scenarios
from mc_nested.cli.app import VERBS, app_for, main
from mc_nested.cli.interrupt import Stopped
from mc_nested.errors import PresetError
from mc_nested.live.input.signals import EndedBySignal
from tests.cli.running import check_mistake, run


def test_only_the_verb_that_is_named_is_loaded() -> None:
    assert len(app_for(["scenarios", "line"]).registered_commands) == 1
    every = app_for(["--help"])
    assert len(every.registered_commands) + len(every.registered_groups) == len(VERBS)


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (PresetError("no preset:\nname one"), 2, "no preset: name one"),
        (Stopped("stopped and saved"), 130, "stopped and saved"),
        (KeyboardInterrupt(), 130, "stopped"),
        (MemoryError(), 2, "not enough memory"),
        (OSError(28, "No space left on device", "/x"), 2, "/x: No space left on device: name another path"),
        (OSError("odd"), 2, "the system: odd: name another path"),
    ],
)
def test_an_error_is_one_line_and_its_exit_code(
    error: BaseException, code: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def app_that_fails(_: object) -> typer.Typer:
        app = typer.Typer()

        @app.command()
        def verb() -> None:
            raise error

        return app

    monkeypatch.setattr(app_module, "app_for", app_that_fails)
    with pytest.raises(SystemExit) as ended:
        main(["--"])
    assert ended.value.code == code
    shown = capsys.readouterr().err
    assert shown.startswith(f"mc-nested: {said}")
    assert shown.count("\n") == 1


def test_the_version_is_the_packages(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--version") == 0
    assert capsys.readouterr().out == f"mc-nested {importlib.metadata.version('mc-nested')}\n"


def test_nothing_but_the_verb_asks_for_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    printed = capsys.readouterr().out
    for verb in ("train", "evaluate", "play", "scenarios", "read", "calibrate"):
        assert verb in printed


def test_what_draws_no_figure_loads_no_matplotlib() -> None:
    code = "import sys, mc_nested.cli.calibrate, mc_nested.cli.doctor; sys.exit('matplotlib' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_importing_everything_needs_no_display() -> None:
    modules = "mc_nested, mc_nested.cli, mc_nested.live.desktop, mc_nested.live.session, sim.grid, calibration"
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-c", f"import {modules}"], env=environment, check=True)


@pytest.mark.parametrize(("ending", "code"), [(KeyboardInterrupt(), 130), (EndedBySignal(15), 143)])
def test_whoever_stops_a_verb_is_told_in_one_line(
    ending: BaseException, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stop() -> list[str]:
        raise ending

    monkeypatch.setattr(scenarios, "shipped_scenarios", stop)
    assert run("scenarios") == code
    assert capsys.readouterr().err == "mc-nested: stopped\n"


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["frobnicate"], "No such command"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(
    arguments: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check_mistake(arguments, says, trained, tmp_path, capsys)
