"""Completion as shells ask for it, through the environment: the user's names, quickly, and what verbs take."""

import os
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Protocol

import platformdirs
import pytest
import typer

from mc_nested.cli.app import HIDDEN, VERBS, app_with
from mc_nested.cli.completion import QUICK, complete_of, complete_profiles, complete_runs
from tests.cli.running import run, verbs_of

COMMAND = "import sys; sys.argv[0] = 'mc-nested'; from mc_nested.cli import main; main()"
"""The command as its script runs it."""

HEAVY = ("torch", "numba", "cv2", "matplotlib", "scipy", "tomlkit")
"""What takes long to load."""


def asked(folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Return what the command answers a shell that asks by these variables."""
    env = {**os.environ, **variables, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder)}
    env["PYTHONPATH"] = os.pathsep.join(filter(None, (str(Path(__file__).parents[2]), os.environ.get("PYTHONPATH"))))
    return subprocess.run(
        [sys.executable, "-c", COMMAND], env=env, cwd=folder, capture_output=True, text=True, check=False
    )


class AskedHere(Protocol):
    """Asks as a shell does, but in this process: a new process takes thirty times as long."""

    def __call__(self, **variables: str) -> tuple[int, str]:
        """Return its exit code and what it prints; check that nothing is printed as an error."""


@pytest.fixture
def asked_here(folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> AskedHere:
    monkeypatch.chdir(folder)
    monkeypatch.setattr(sys, "argv", ["mc-nested"])

    def ask(**variables: str) -> tuple[int, str]:
        for name, value in {**variables, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder)}.items():
            monkeypatch.setenv(name, value)
        code = run()
        printed = capsys.readouterr()
        assert printed.err == ""
        return code, printed.out

    return ask


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "runs" / "line").mkdir(parents=True)
    (tmp_path / "runs" / "line" / "config.toml").touch()
    (tmp_path / "mc-nested" / "profiles").mkdir(parents=True)
    (tmp_path / "mc-nested" / "profiles" / "laptop.toml").touch()
    return tmp_path


def test_bash_gets_one_word_a_line_from_a_new_process(folder: Path) -> None:
    answer = asked(folder, COMP_WORDS="mc-nested re", COMP_CWORD="1", _MC_NESTED_COMPLETE="complete_bash")
    assert (answer.returncode, answer.stderr) == (0, "")
    assert sorted(answer.stdout.split()) == sorted(verb for verb in VERBS if verb.startswith("re"))


@pytest.mark.parametrize(
    ("typed", "completed"),
    [
        ("train --pre", ["--preset"]),
        ("train --preset t", ["tuned"]),
        ("train --scenario zig", ["zigzag"]),
        ("train --resume ", ["runs/line"]),
        ("play ", ["runs/line"]),
        ("play runs/line --backend l", ["live"]),
        ("play --profile l", ["laptop"]),
        ("runs de", ["delete"]),
        ("profiles delete ", ["laptop"]),
        ("calibrate arena --un", ["--undo"]),
        ("scenarios line h", ["house"]),
        ("study benchmark --agents nested,s", ["nested,single", "nested,sb3"]),
        ("read ", []),
        ("train --out ", []),
        ("nothing x", []),
    ],
)
def test_bash_gets_the_words_that_can_stand_at_that_place(
    typed: str, completed: list[str], asked_here: AskedHere
) -> None:
    words = ["mc-nested", *typed.split(" ")]
    variables = {"COMP_WORDS": " ".join(words), "COMP_CWORD": str(len(words) - 1)}
    code, answer = asked_here(**variables, _MC_NESTED_COMPLETE="complete_bash")
    assert code == 0
    assert sorted(answer.split()) == sorted(completed)


def test_zsh_gets_each_option_with_its_help(asked_here: AskedHere) -> None:
    asks = {"_MC_NESTED_COMPLETE": "complete_zsh"}
    assert asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --pres") == (
        0,
        """_arguments '*: :(("--preset":"hyper-parameters"))'\n""",
    )
    assert asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --out ") == (0, "_files\n")


def test_fish_gets_the_help_behind_a_tab_and_is_told_where_files_are_meant(asked_here: AskedHere) -> None:
    asks = {"_MC_NESTED_COMPLETE": "complete_fish", "_TYPER_COMPLETE_FISH_ACTION": "get-args"}
    assert asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --preset p") == (0, "paper\n")
    found = asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --pres")
    assert found == (0, "--preset\thyper-parameters\n")
    asks["_TYPER_COMPLETE_FISH_ACTION"] = "is-args"
    assert asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --preset p")[0] == 0
    assert asked_here(**asks, _TYPER_COMPLETE_ARGS="mc-nested train --out ")[0] == 1


def test_powershell_gets_the_help_behind_colons(asked_here: AskedHere) -> None:
    found = asked_here(
        _MC_NESTED_COMPLETE="complete_powershell",
        _TYPER_COMPLETE_ARGS="mc-nested train --pres",
        _TYPER_COMPLETE_WORD_TO_COMPLETE="--pres",
    )
    assert found == (0, "--preset:::hyper-parameters\n")


@pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")
def test_real_bash_completes_with_the_printed_script(folder: Path) -> None:
    command = f"""#!/bin/sh\nexec "{sys.executable}" -c "{COMMAND}" "$@"\n"""
    (folder / "mc-nested").rename(folder / "config")
    (folder / "bin").mkdir()
    (folder / "bin" / "mc-nested").write_text(command)
    (folder / "bin" / "mc-nested").chmod(0o755)
    script = """
        eval "$(mc-nested --show-completion)"
        complete -p mc-nested
        COMP_WORDS=(mc-nested play "") COMP_CWORD=2
        _mc_nested_completion mc-nested
        echo "${COMPREPLY[*]}"
    """
    env = {**os.environ, "PATH": f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}", "HOME": str(folder)}
    env["PYTHONPATH"] = str(Path(__file__).parents[2])
    bash = ["bash", "--norc", "-c", textwrap.dedent(script)]
    done = subprocess.run(bash, env=env, cwd=folder, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["complete -o default -F _mc_nested_completion mc-nested", "runs/line"]


def test_completion_loads_no_verb_and_no_large_library(folder: Path) -> None:
    code = f"""
        import atexit, sys
        atexit.register(lambda: print([name for name in {HEAVY} if name in sys.modules], file=sys.stderr))
        atexit.register(lambda: print("mc_nested.cli.train" in sys.modules, file=sys.stderr))
        {COMMAND}
    """
    env = {
        **os.environ,
        "HOME": str(folder),
        "XDG_CONFIG_HOME": str(folder),
        "PYTHONPATH": str(Path(__file__).parents[2]),
    }
    env |= {"_MC_NESTED_COMPLETE": "complete_bash", "COMP_WORDS": "mc-nested play --profile ", "COMP_CWORD": "3"}
    command = [sys.executable, "-c", textwrap.dedent(code)]
    done = subprocess.run(command, env=env, cwd=folder, capture_output=True, text=True, check=True)
    assert done.stdout == "laptop\n"
    assert done.stderr.splitlines() == ["False", "[]"]


def test_options_that_complete_runs_or_profiles_are_those_of_the_quick_table(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(folder))
    found = set()
    for words, command in verbs_of(app_with({**VERBS, **HIDDEN})):
        for each in command.params:
            values = {item.value for item in each.shell_complete(typer.Context(command), "")}
            if values & {"runs/line", "laptop"}:
                found.add(each.opts[0] if each.param_type_name == "option" else words)
    assert found == set(QUICK)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with runs/a, runs/b, other/c, and files and folders that are not runs."""
    monkeypatch.chdir(tmp_path)
    for name in ("runs/a", "runs/b", "other/c"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "config.toml").touch()
    (tmp_path / "runs" / "empty").mkdir()
    (tmp_path / "runs" / "file").touch()
    return tmp_path


@pytest.mark.parametrize("typed", ["", "r", "runs", "runs/"])
def test_runs_in_the_folder_runs_are_completed(typed: str, here: Path) -> None:
    assert [Path(name) for name in complete_runs(typed)] == [Path("runs/a"), Path("runs/b")]
    assert here.exists()


def test_runs_in_the_typed_folder_are_completed(here: Path) -> None:
    assert complete_runs("runs/b") == [str(Path("runs/b"))]
    assert complete_runs(f"{here}/other/") == [f"{here}/other/c"]
    assert complete_runs(f"{here}/other/c") == [f"{here}/other/c"]
    assert complete_runs("other/x") == []


def test_without_runs_or_profiles_nothing_is_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path / "missing")
    assert complete_runs("") == complete_runs("a/b/c") == complete_profiles("") == []


def test_named_profiles_are_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    (tmp_path / "profiles" / "laptop-points").mkdir(parents=True)
    for name in ("laptop.toml", "laptop.toml.before", "pc.toml"):
        (tmp_path / "profiles" / name).touch()
    assert complete_profiles("") == ["laptop", "pc"]
    assert complete_profiles("l") == ["laptop"]


def test_last_of_several_names_is_completed() -> None:
    names = complete_of(lambda: ["model-based", "paper", "tuned"])
    assert names("") == ["model-based", "paper", "tuned"]
    assert names("t") == ["tuned"]
    assert names("model-based,p") == ["model-based,paper"]
    assert names("x") == []
