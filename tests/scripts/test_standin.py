"""The stand-in's commands, and, marked standin, the window itself."""

import json
import re
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from mc_nested.live.profile.store import load_profile
from scripts import standin as script
from scripts.standin_game import STOPPED, last_line, write_profile
from scripts.standin_parts import NODE_FOLDER
from scripts.window_display import wait_until
from tests.standin_fixture import Standin

for_linux = pytest.mark.skipif(sys.platform != "linux", reason="the stand-in is for Linux")


def test_the_status_is_down_before_anything_is_started(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert script.main(["status"], tmp_path) == 1
    line, state = capsys.readouterr().out.splitlines()
    assert line == "the stand-in is down"
    assert json.loads(state) == {"ready": False}


def test_down_may_be_run_twice(tmp_path: Path) -> None:
    assert script.main(["down"], tmp_path) == 0
    assert script.main(["down"], tmp_path) == 0


@pytest.mark.parametrize("arguments", [[], ["sideways"], ["up", "down"]])
def test_unknown_arguments_are_refused(arguments: list[str], tmp_path: Path) -> None:
    with pytest.raises(SystemExit) as refusal:
        script.main(arguments, tmp_path)
    assert refusal.value.code == 2


def test_another_operating_system_is_refused_in_one_line_that_says_what_to_do(
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
    assert "sudo apt-get install --no-install-recommends chromium nodejs npm x11-xkb-utils xdotool xvfb" in line
    assert not (tmp_path / "state.json").exists()


def keeper(code: str) -> tuple[str, ...]:
    """Put a program in the keeper's place, which has its lock."""
    begin = "import json, os, sys, time; from pathlib import Path; from mc_nested.file_lock import file_lock\n"
    begin += "from scripts.standin_game import KEEPER, STATE\ncache = Path(sys.argv[1])\n"
    return (sys.executable, "-c", f"{begin}with file_lock(cache / KEEPER):\n{textwrap.indent(code, '    ')}")


ANSWERS = """\
import http.server
class Oracle(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.end_headers()
        self.wfile.write(b'{"position": [0, 0, 0]}')
server = http.server.HTTPServer(("127.0.0.1", 0), Oracle)
state = {"ready": True, "oracle": f"http://127.0.0.1:{server.server_port}", "pids": {"keeper": os.getpid()}}
(cache / "unfinished").write_text(json.dumps(state))
(cache / "unfinished").replace(cache / STATE)
server.serve_forever()
"""


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Callable[[str], Path]]:
    """Put a program in the keeper's place, and return the cache."""
    monkeypatch.setattr(script, "fetch_all", lambda *_: None)

    def keeps(code: str) -> Path:
        monkeypatch.setattr(script, "KEEP", keeper(code))
        return tmp_path

    yield keeps
    assert script.main(["down"], tmp_path) == 0


@for_linux
def test_the_stand_in_is_up_until_it_is_taken_down(
    kept: Callable[[str], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    cache = kept(ANSWERS)
    assert script.main(["up"], cache) == 0
    state = json.loads(capsys.readouterr().out)
    assert script.keeper_of(cache) == state["pids"]["keeper"]
    assert script.main(["up"], cache) == script.main(["status"], cache) == 0
    again, line, shown = capsys.readouterr().out.splitlines()
    assert line == "the stand-in is up"
    assert json.loads(again) == json.loads(shown) == state
    assert script.main(["down"], cache) == 0
    assert script.keeper_of(cache) is None
    assert script.main(["status"], cache) == 1


@for_linux
def test_stand_in_that_fails_to_start_gives_its_exit_code_and_is_down(kept: Callable[[str], Path]) -> None:
    assert script.main(["up"], kept("sys.exit(3)")) == 3
    assert script.main(["status"], kept("")) == 1


@for_linux
def test_a_stand_in_whose_world_does_not_answer_is_half_up_and_is_started_anew(
    kept: Callable[[str], Path], capsys: pytest.CaptureFixture[str]
) -> None:
    cache = kept('(cache / STATE).write_text(\'{"ready": true, "oracle": "http://127.0.0.1:1"}\'); time.sleep(60)')
    assert script.main(["up"], cache) == 0
    deaf = script.keeper_of(cache)
    capsys.readouterr()
    assert script.main(["status"], cache) == 1
    assert capsys.readouterr().out.startswith("the stand-in is half up: take it down\n")
    assert script.main(["up"], kept(ANSWERS)) == 0
    assert script.keeper_of(cache) not in (None, deaf)


@for_linux
def test_ctrl_c_during_up_ends_the_keeper(kept: Callable[[str], Path], monkeypatch: pytest.MonkeyPatch) -> None:
    cache = kept("time.sleep(60)")

    def interrupted(_seconds: float) -> None:
        assert wait_until(lambda: script.keeper_of(cache) is not None, 10)
        raise KeyboardInterrupt

    monkeypatch.setattr(script, "time", SimpleNamespace(sleep=interrupted))
    assert script.main(["up"], cache) == STOPPED
    assert script.keeper_of(cache) is None


def test_last_line_of_a_log_is_its_last_line_that_is_not_blank(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.write_bytes(b"first\nlast \xff\n \n\n")
    assert last_line(log) == "last \N{REPLACEMENT CHARACTER}"
    log.write_bytes(b"")
    assert "is empty" in last_line(log)


def test_profile_of_the_stand_in_is_loaded_by_mc_nested(tmp_path: Path) -> None:
    profile = load_profile(write_profile(tmp_path / "profile.toml", Path("/some/where/ascii.png")))
    assert profile.screen.font_path() == Path("/some/where/ascii.png")
    assert profile.game.dialect == "1.17"
    assert profile.shown_id("stone") == "stone"
    assert re.search(profile.window.title, "Prismarine Web Client - Chromium")
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
def test_block_that_the_server_refuses_leaves_player_and_world_unchanged(standin: Standin) -> None:
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
