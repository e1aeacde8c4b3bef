"""The command loads only the verb that is named, and turns an error into one line and an exit code."""

import importlib.metadata
import os
import subprocess
import sys
from typing import Any

import pytest
import typer

from mc_nested.cli import app as app_module
from mc_nested.cli import scenarios
from mc_nested.cli.app import HIDDEN, VERBS, app_for, app_with, main
from mc_nested.cli.interrupt import Stopped
from mc_nested.errors import PresetError
from mc_nested.live.input.signals import EndedBySignal
from tests.cli.running import run

HEAVY = ("torch", "numba", "cv2", "matplotlib", "scipy")


def commands_of(*words: str) -> dict[str, Any]:
    commands: dict[str, Any] = getattr(app_for(words), "commands", {})
    return commands


def test_only_the_verb_that_is_named_is_loaded() -> None:
    commands = commands_of("scenarios", "line")
    assert list(commands) == [*VERBS, *HIDDEN]
    assert [verb for verb, each in commands.items() if each.params] == ["scenarios"]
    assert [verb for verb, each in commands_of("--help").items() if each.params] == []
    assert [verb for verb, each in commands.items() if each.hidden] == list(HIDDEN)


def test_listed_lines_are_those_of_the_verbs_themselves() -> None:
    listed, loaded = commands_of("--help"), app_with({**VERBS, **HIDDEN}).commands
    whole = 1000
    assert [VERBS[verb] for verb in VERBS] == [loaded[verb].get_short_help_str(whole) for verb in VERBS]
    assert [listed[verb].get_short_help_str() for verb in VERBS] == [
        loaded[verb].get_short_help_str() for verb in VERBS
    ]


@pytest.mark.parametrize("words", [["--help"], ["--version"], []])
def test_help_and_version_load_nothing_that_takes_long(words: list[str]) -> None:
    code = f"""
import atexit, sys
atexit.register(lambda: print([name for name in {HEAVY} if name in sys.modules], file=sys.stderr))
from mc_nested.cli import main
main({words})
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr == "[]\n"
    assert "mc-nested" in done.stdout


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
def test_error_is_printed_in_one_line_and_sets_the_exit_code(
    error: BaseException, code: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def app_that_fails(_: object) -> object:
        app = typer.Typer()

        @app.command()
        def verb() -> None:
            raise error

        return typer.main.get_command(app)

    monkeypatch.setattr(app_module, "app_for", app_that_fails)
    with pytest.raises(SystemExit) as ended:
        main(["--"])
    assert ended.value.code == code
    shown = capsys.readouterr().err
    assert shown.startswith(f"mc-nested: {said}")
    assert shown.count("\n") == 1


def test_version_option_prints_the_package_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--version") == 0
    assert capsys.readouterr().out == f"mc-nested {importlib.metadata.version('mc-nested')}\n"


def test_command_without_words_prints_the_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    printed = capsys.readouterr().out
    for verb in ("train", "play", "scenarios", "calibrate"):
        assert verb in printed


def test_calibrate_and_doctor_do_not_import_matplotlib() -> None:
    code = "import sys, mc_nested.cli.calibrate, mc_nested.cli.doctor; sys.exit('matplotlib' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_importing_everything_needs_no_display() -> None:
    modules = "mc_nested, mc_nested.cli, mc_nested.live.desktop, mc_nested.live.session, sim.grid, calibration"
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-c", f"import {modules}"], env=environment, check=True)


@pytest.mark.parametrize(("ending", "code"), [(KeyboardInterrupt(), 130), (EndedBySignal(15), 143)])
def test_stopped_verb_says_so_in_one_line(
    ending: BaseException, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stop() -> list[str]:
        raise ending

    monkeypatch.setattr(scenarios, "shipped_scenarios", stop)
    assert run("scenarios") == code
    assert capsys.readouterr().err == "mc-nested: stopped\n"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["runs", "--json", "list"], "write --json at the end: mc-nested runs list --json"),
        (["profiles", "--json", "list"], "write --json at the end: mc-nested profiles list --json"),
        (["recordings", "--json", "trim"], "mc-nested recordings trim takes no --json: leave it out"),
        (["train", "--seed", "3", "serve"], "mc-nested train serve takes no --seed: leave it out"),
        (
            ["doctor", "--profile", "x", "bug-report"],
            "write --profile at the end: mc-nested doctor bug-report --profile",
        ),
    ],
)
def test_option_before_a_sub_verb_is_refused(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*words) == 2
    assert capsys.readouterr().err == f"mc-nested: {says}\n"
