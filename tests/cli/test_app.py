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
from mc_nested.cli.app import HIDDEN, MOVED, VERBS, app_for, main
from mc_nested.cli.interrupt import Stopped
from mc_nested.errors import PresetError
from mc_nested.live.input.signals import EndedBySignal
from tests.cli.running import run


def commands_of(*words: str) -> dict[str, Any]:
    commands: dict[str, Any] = getattr(app_for(words), "commands", {})
    return commands


def test_only_the_verb_that_is_named_is_loaded() -> None:
    assert list(commands_of("scenarios", "line")) == ["scenarios"]
    assert list(commands_of("--help")) == [*VERBS, *HIDDEN]
    assert [verb for verb, each in commands_of("--help").items() if each.hidden] == list(HIDDEN)


@pytest.mark.parametrize("verb", MOVED)
def test_former_verb_name_is_refused_with_its_new_name(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(verb, "--help") == 2
    assert capsys.readouterr().err == f"mc-nested: {verb} is now mc-nested {MOVED[verb]}\n"
    words = [word for word in MOVED[verb].partition(",")[0].split() if not word.startswith("--")]
    assert run(*words, "--help") == 0


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
