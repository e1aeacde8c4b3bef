"""The stand-in's commands, and, marked standin, the window itself."""

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mc_nested.live.profile.store import load_profile
from scripts import standin as script
from scripts.standin_game import write_profile
from scripts.standin_parts import NODE_FOLDER
from scripts.standin_processes import wait_until
from tests.standin_fixture import Standin


def test_nothing_started_is_down(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert script.main(["status"], tmp_path) == 1
    line, state = capsys.readouterr().out.splitlines()
    assert line == "the stand-in is down"
    assert json.loads(state) == {"ready": False}


def test_down_twice_is_fine(tmp_path: Path) -> None:
    assert script.main(["down"], tmp_path) == 0
    assert script.main(["down"], tmp_path) == 0


@pytest.mark.parametrize("arguments", [[], ["sideways"], ["up", "down"]])
def test_other_words_are_refused(arguments: list[str], tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as refusal:
        script.main(arguments, tmp_path)
    assert refusal.value.code == 2


def test_another_system_is_refused_in_one_line_that_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert script.main(["up"], tmp_path) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "needs Linux" in line


def test_without_the_programs_one_line_says_how_to_get_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert script.main(["up"], tmp_path) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "sudo apt-get install --no-install-recommends nodejs npm xvfb chromium xdotool" in line
    assert not (tmp_path / "state.json").exists()


@pytest.mark.parametrize("command", ["up", "down", "status"])
def test_a_damaged_state_is_neither_trusted_nor_deleted(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    state = tmp_path / "state.json"
    state.write_text('{"ready": true, "processes": [{"pid": 1}]}')
    assert script.main([command], tmp_path) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert str(state) in line
    assert state.exists()


def test_the_profile_is_one_that_mc_nested_reads(tmp_path: Path) -> None:
    profile = load_profile(write_profile(tmp_path / "profile.toml", Path("/some/where/ascii.png")))
    assert profile.screen.font_path() == Path("/some/where/ascii.png")
    assert profile.game.dialect == "1.17"
    assert profile.shown_id("stone") == "stone"
    assert profile.window.matches("Prismarine Web Client - Chromium")
    assert profile.marked_arena().centre_of((7, 14)) == (8.5, 5.0, 15.5)


def test_the_lock_file_names_no_registry() -> None:
    assert '"resolved"' not in (NODE_FOLDER / "package-lock.json").read_text(encoding="utf-8")


HOLD_A_KEY = """
import sys, time
from pynput.keyboard import Controller
keyboard = Controller()
keyboard.press(sys.argv[1])
time.sleep(float(sys.argv[2]))
keyboard.release(sys.argv[1])
time.sleep(0.5)
"""


@pytest.mark.standin
def test_a_held_key_walks_in_the_stand_in(standin: Standin) -> None:
    x, y, z = standin.position()
    subprocess.run([sys.executable, "-c", HOLD_A_KEY, "w", "0.3"], env=standin.env, timeout=30, check=True)
    walked_x, walked_y, walked_z = standin.position()
    assert (walked_x, walked_y) == (x, y)
    assert walked_z > z + 0.2
    assert standin.blocks((0, 4, 0), (1, 6, 0)) == {(0, 4, 0): "stone", (1, 4, 0): "stone"}
    assert standin.errors() == []


TYPE_AND_ENTER = """
import sys, time
from pynput.keyboard import Controller, Key
keyboard = Controller()
keyboard.type(sys.argv[1])
time.sleep(0.3)
keyboard.press(Key.enter)
time.sleep(0.1)
keyboard.release(Key.enter)
"""
HOLD_THE_RIGHT_BUTTON = """
import time
from pynput.mouse import Button, Controller
mouse = Controller()
mouse.press(Button.right)
time.sleep(0.2)
mouse.release(Button.right)
"""
CLIENT_GIVES_UP_S = 5.0
"""The client waits this long for the server to say that the block is there."""
ANSWER_S = 10.0
"""A command or a key takes effect within this, on a machine that is busy with other work, too."""


def _do(standin: Standin, program: str, *arguments: str) -> None:
    subprocess.run([sys.executable, "-c", program, *arguments], env=standin.env, timeout=30, check=True)


def _say(standin: Standin, command: str) -> None:
    _do(standin, HOLD_A_KEY, "t", "0.1")
    assert wait_until(standin.is_chatting, ANSWER_S)
    _do(standin, TYPE_AND_ENTER, command)
    assert wait_until(lambda: not standin.is_chatting(), ANSWER_S)


@pytest.mark.standin
def test_a_block_that_the_server_refuses_changes_nothing_as_in_the_game(standin: Standin) -> None:
    _say(standin, "/item replace entity @s hotbar.0 with stone 1")
    _say(standin, "/fill 8 5 8 8 6 8 air")
    _say(standin, "/tp @s 8.5 5 8.5 0 90")
    assert wait_until(lambda: standin.position() == (8.5, 5, 8.5), ANSWER_S)
    _do(standin, HOLD_A_KEY, "1", "0.1")
    assert wait_until(lambda: standin.held() == "stone", ANSWER_S)
    _do(standin, HOLD_THE_RIGHT_BUTTON)
    time.sleep(CLIENT_GIVES_UP_S + 1)
    assert standin.position() == (8.5, 5, 8.5)
    assert standin.blocks((8, 5, 8), (8, 6, 8)) == {}
    assert standin.errors() == []
    assert standin.is_playing()


@pytest.mark.standin
@pytest.mark.parametrize(("text", "times"), [("none", 0), ("lastPlaced, lastPlaced", 2)])
def test_a_patch_that_does_not_match_once_is_refused(text: str, times: int, standin: Standin) -> None:
    code = "require(process.argv[1]).patchedOnce(process.argv[2], [['lastPlaced', 'x']])"
    asked = ["node", "-e", code, str(NODE_FOLDER / "patch.js"), text]
    refused = subprocess.run(asked, env=standin.env, capture_output=True, text=True, timeout=30, check=False)
    assert refused.returncode == 1
    assert f"matches {times} times instead of once: lastPlaced" in refused.stderr
