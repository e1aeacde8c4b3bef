"""The doctor on a virtual client: every row in every state, each fault in its own row, and nothing left behind."""

import math
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.doctor.check import CheckName
from calibration.installation.processes import Process
from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.devices import Devices, Frame, Region
from mc_nested.live.profile.tables import CalibratedTable, KeysTable, Profile, ScreenTable
from sim.client.client import VirtualClient
from sim.client.game.debug_entries import GAME_DEFAULT
from sim.client.game.options import GameOptions
from sim.client.mishaps import Kind
from sim.client.settings import ClientSettings
from tests.calibration.doctor.examined import GOOD, Computer, opened, rows, statuses

DOWN = 65.0
"""Degrees: the ground is looked at."""

LOOKING_DOWN = ClientSettings(pitch=DOWN)

SOON_S = 0.7


@pytest.fixture
def computer(tmp_path: Path) -> Computer:
    return Computer(tmp_path)


def client_in(change: Callable[[VirtualClient], object], choices: ClientSettings = LOOKING_DOWN) -> VirtualClient:
    """Return a virtual client to which something has happened a moment ago."""
    client = VirtualClient(choices)
    change(client)
    client.clock.sleep(SOON_S)
    return client


def as_it_was(_client: VirtualClient) -> None:
    """Leave the client as it is."""


def is_untouched(client: VirtualClient) -> bool:
    """Return whether no key is down, no other window was typed into, and the world is as it was."""
    return not client.window.down and not client.window.strays and not client.built


@pytest.mark.parametrize("version", ["1.12.2", "1.15.2", "1.20.1", "1.21.9", "26.1"])
@pytest.mark.parametrize(("size", "scale"), [((640, 480), 1), ((960, 540), 2), ((1440, 810), 3)])
def test_a_game_that_can_be_played_passes_every_row(
    version: str, size: tuple[int, int], scale: int, computer: Computer
) -> None:
    client = client_in(as_it_was, ClientSettings(pitch=DOWN, version=version, size=size, scale=scale))
    calibrated = CalibratedTable(date="2026-11-21", version=version, window=size, gui_scale=scale)
    computer.save(Profile(screen=ScreenTable(font=str(computer.font)), calibrated=calibrated))
    computer.options.write_text(GOOD.replace("guiScale:2", f"guiScale:{scale}"), "utf-8")
    found = computer.examined(opened(client), clipboard=client.clipboard)
    assert statuses(found) == dict.fromkeys(CheckName, "pass")
    assert client.game.has_f3
    assert is_untouched(client)
    assert not computer.said


def test_row_details_give_the_title_size_position_block_and_options_file(computer: Computer) -> None:
    said = rows(computer.examined(opened(client_in(as_it_was)), clipboard=None))
    assert said["game's window"].detail == "'Minecraft 1.20.1 - Singleplayer'"
    assert said["size and GUI scale"].detail.startswith("854 x 480 pixels, GUI scale 2: only 427 GUI pixels wide")
    assert said["display scaling"].detail == "1 pixels to a point: 854 x 480 for 854 x 480"
    assert said["position line"].detail == "XYZ: 0.500 / 64.000 / 0.500"
    assert said["looked-at line"].detail == "minecraft:bedrock at 0 63 1"
    assert said["options.txt"].detail == f"Minecraft Launcher: {computer.options}"
    assert said["clipboard"].status == "skip"


@pytest.mark.parametrize(
    ("change", "choices", "failing", "skipped"),
    [
        (as_it_was, ClientSettings(has_f3=False), {"debug screen"}, {"size and GUI scale", "position line", "input"}),
        (
            lambda client: client.realm.rules.update(reducedDebugInfo="true"),
            LOOKING_DOWN,
            {"reduced debug info", "position line"},
            {"looked-at line", "input"},
        ),
        (lambda client: client.game.open("pause"), LOOKING_DOWN, {"debug screen"}, {"position line", "input"}),
        (lambda client: client.game.open("chat"), LOOKING_DOWN, {"debug screen"}, {"input"}),
        (lambda client: client.game.die(), LOOKING_DOWN, {"debug screen"}, {"position line", "input"}),
        (lambda client: client.game.open("title"), LOOKING_DOWN, {"debug screen"}, {"position line", "input"}),
        (lambda client: client.game.open("worlds"), LOOKING_DOWN, {"debug screen"}, {"position line", "input"}),
        (lambda client: client.set_front(is_in_front=False), LOOKING_DOWN, {"in front"}, {"debug screen", "input"}),
        (
            as_it_was,
            ClientSettings(pitch=DOWN, version="1.21.9", debug_entries=GAME_DEFAULT),
            {"looked-at line", "profile fits"},
            {"input"},
        ),
        (
            as_it_was,
            ClientSettings(pitch=-30.0, version="1.21.9", debug_entries=GAME_DEFAULT),
            {"looked-at line", "profile fits"},
            {"input"},
        ),
        (as_it_was, ClientSettings(pitch=DOWN, version="1.19.4"), {"profile fits"}, set()),
        (lambda client: client.resize((1024, 768)), LOOKING_DOWN, {"profile fits"}, set()),
        (as_it_was, ClientSettings(pitch=DOWN, scale=1), {"profile fits"}, set()),
    ],
    ids=[
        "no F3",
        "reduced",
        "pause",
        "chat",
        "death",
        "title",
        "worlds",
        "behind",
        "no looked-at line",
        "looking up",
        "version",
        "size",
        "scale",
    ],
)
def test_each_fault_fails_only_its_own_rows_and_leaves_the_game_as_it_was(
    change: Callable[[VirtualClient], object],
    choices: ClientSettings,
    failing: set[str],
    skipped: set[str],
    computer: Computer,
) -> None:
    client = client_in(change, choices)
    screen, has_f3, feet = client.game.screen, client.game.has_f3, client.realm.player.feet
    found = computer.examined(opened(client), clipboard=client.clipboard)
    seen = statuses(found)
    assert tuple(seen) == tuple(CheckName)
    assert {name for name, status in seen.items() if status == "fail"} == failing
    assert {name for name, status in seen.items() if status == "skip"} >= skipped
    assert (client.game.screen, client.game.has_f3) == (screen, has_f3)
    assert is_untouched(client)
    assert "input" not in skipped or client.realm.player.feet == feet
    assert all(check.fix for check in found.checks if check.status == "fail")


def test_fix_for_a_hidden_looked_at_line_is_to_switch_its_entry_on(computer: Computer) -> None:
    client = client_in(as_it_was, ClientSettings(pitch=DOWN, version="1.21.9", debug_entries=GAME_DEFAULT))
    row = rows(computer.examined(opened(client)))["looked-at line"]
    assert "F3+F6" in row.fix
    assert "65 degrees down" in row.detail


def test_a_player_who_looks_into_the_sky_is_asked_to_look_down(computer: Computer) -> None:
    client = VirtualClient(pitch=-30.0)
    row = rows(computer.examined(opened(client)))["looked-at line"]
    assert (row.status, row.fix) == ("skip", "look down at the ground, and run this again")


def test_the_game_that_comes_to_the_front_in_time_is_examined(computer: Computer) -> None:
    client = client_in(
        lambda client: client.set_front(is_in_front=False),
        ClientSettings(pitch=DOWN, options=GameOptions(pause_on_lost_focus=False), size=(960, 540)),
    )
    calibrated = CalibratedTable(date="2026-11-21", version="1.20.1", window=(960, 540), gui_scale=2)
    computer.save(Profile(screen=ScreenTable(font=str(computer.font)), calibrated=calibrated))
    client.clock.call_at(client.clock.now() + 12, lambda: client.set_front(is_in_front=True))
    found = computer.examined(opened(client), clipboard=client.clipboard)
    assert statuses(found) == dict.fromkeys(CheckName, "pass")
    assert len(computer.said) == 1
    assert "Switch to the game" in computer.said[0]


def test_game_menu_closed_in_time_does_not_fail_the_debug_screen_row(computer: Computer) -> None:
    client = client_in(lambda client: client.game.open("pause"))
    client.clock.call_at(client.clock.now() + 2, lambda: client.game.open("world"))
    assert statuses(computer.examined(opened(client)))["debug screen"] == "pass"


def no_window(title: str) -> AbstractContextManager[Devices]:
    raise NoWindowError(f"no window's title matches {title!r}: start the game")


def several(title: str) -> AbstractContextManager[Devices]:
    raise DesktopError(f"2 windows' titles match {title!r}: close all but the game's")


def no_session() -> str:
    raise DesktopError("no display (DISPLAY is not set): run this in the desktop session that shows the game")


def test_without_a_game_every_row_is_reported_and_the_files_are_checked(computer: Computer) -> None:
    found = computer.examined(no_window)
    seen = statuses(found)
    assert tuple(seen) == tuple(CheckName)
    assert {name for name, status in seen.items() if status == "fail"} == {"game's window"}
    assert {"profile", "font", "options.txt", "autoJump", "keys"} <= {
        name for name, status in seen.items() if status == "pass"
    }
    assert (seen["input"], seen["profile fits"]) == ("skip", "skip")
    assert found.is_window_closed is True


def test_several_game_windows_fail_the_window_row_and_do_not_count_as_closed(computer: Computer) -> None:
    found = computer.examined(several)
    assert (statuses(found)["game's window"], found.is_window_closed) == ("fail", False)


def test_without_desktop_profile_or_options_every_row_is_reported(tmp_path: Path) -> None:
    computer = Computer(tmp_path, options=None)
    computer.profile.unlink()
    found = computer.examined(several, session=no_session)
    seen = statuses(found)
    assert tuple(seen) == tuple(CheckName)
    assert seen.pop("session") == "fail"
    assert set(seen.values()) == {"skip"}
    assert found.is_window_closed is None
    assert rows(found)["session"].fix == "run this in the desktop session that shows the game"


def test_a_font_is_found_in_a_launchers_folder_where_the_profile_names_none(computer: Computer) -> None:
    computer.save(Profile())
    assert rows(computer.examined(opened(client_in(as_it_was))))["font"].fix.startswith("name your game's client jar")
    jar = computer.jar_with_the_font()
    found = rows(computer.examined(opened(client_in(as_it_was))))
    assert found["debug screen"].status == "pass"
    assert found["font"].detail == f"found, of Minecraft 1.20.1: {jar}"


def test_with_a_named_font_and_no_profile_the_keys_are_tried(computer: Computer) -> None:
    computer.profile.unlink()
    found = computer.examined(opened(client_in(as_it_was)), font=computer.font)
    assert statuses(found)[CheckName.FONT] == "pass"
    assert statuses(found)[CheckName.INPUT] == "pass"


def test_unreadable_font_fails_its_row_and_another_font_reads_the_screen(computer: Computer) -> None:
    computer.save(Profile(screen=ScreenTable(font=str(computer.system.home / "gone.jar"))))
    computer.jar_with_the_font()
    found = rows(computer.examined(opened(client_in(as_it_was))))
    assert found["debug screen"].status == "pass"
    assert found["font"].status == "fail"
    assert "gone.jar" in found["font"].detail


def test_unreadable_font_with_no_other_fails_its_row_and_nothing_is_pressed(computer: Computer) -> None:
    computer.font.write_bytes(b"no jar")
    client = client_in(as_it_was)
    found = rows(computer.examined(opened(client)))
    assert found["font"].status == "fail"
    assert (found["debug screen"].status, found["input"].status) == ("skip", "skip")
    assert is_untouched(client)


@pytest.mark.parametrize(
    ("text", "said"),
    [("[window", "not TOML"), ("[calibrated]\nformat = 9\ndate = '2030-01-01'", "a profile of format 9")],
)
def test_unusable_profile_fails_its_row_and_the_other_rows_are_checked_without_it(
    text: str, said: str, computer: Computer
) -> None:
    computer.profile.write_text(text, "utf-8")
    found = rows(computer.examined(opened(client_in(as_it_was))))
    assert (found["profile"].status, found["profile fits"].status) == ("fail", "skip")
    assert said in found["profile"].detail
    assert found["game's window"].status == "pass"
    assert computer.profile.read_text("utf-8") == text


def test_gui_scale_that_differs_from_the_profiles_is_measured_and_fails_its_row(computer: Computer) -> None:
    computer.save(Profile(screen=ScreenTable(font=str(computer.font), debug_scale=1)))
    row = rows(computer.examined(opened(client_in(as_it_was))))["size and GUI scale"]
    assert (row.status, row.detail) == (
        "fail",
        "854 x 480 pixels, GUI scale 2, and the profile's screen.debug_scale is 1",
    )


def test_debug_key_without_an_effect_fails_the_input_row(computer: Computer) -> None:
    computer.save(Profile(screen=ScreenTable(font=str(computer.font)), keys=KeysTable(debug="f10")))
    client = client_in(as_it_was)
    row = rows(computer.examined(opened(client)))["input"]
    assert (row.status, row.detail) == ("fail", "f10 was pressed, and the debug screen stayed on")
    assert is_untouched(client)


@pytest.mark.parametrize("lost", [1, 2, 3])
def test_lost_key_press_leaves_the_debug_screen_on_and_no_key_down(lost: int, computer: Computer) -> None:
    client = client_in(as_it_was)
    client.window.to_drop = lost
    row = rows(computer.examined(opened(client)))["input"]
    assert row.status in ("pass", "fail")
    assert not client.window.down
    assert client.game.has_f3


@pytest.mark.parametrize(
    "kind",
    [
        *("pause", "chat", "inventory", "death", "lost_focus", "disconnect"),
        *("resized_window", "moved_window", "black_frame", "frozen_frame", "lag"),
    ],
)
@pytest.mark.parametrize("after_s", [0.05, 0.25])
def test_after_a_mishap_no_key_stays_down_and_none_goes_to_another_window(
    kind: Kind, after_s: float, computer: Computer
) -> None:
    client = client_in(as_it_was)
    client.mishaps.plan(kind, after_s)
    found = computer.examined(opened(client))
    assert tuple(statuses(found)) == tuple(CheckName)
    assert is_untouched(client)
    assert client.game.chat.typed in (None, "")
    assert math.dist(client.realm.player.feet, (0.5, 64.0, 0.5)) < 0.5


def test_game_played_in_a_custom_folder_is_found_by_its_process(computer: Computer, tmp_path: Path) -> None:
    own = tmp_path / "own game"
    own.mkdir()
    (own / "options.txt").write_text(GOOD.replace("autoJump:false", "autoJump:true"), "utf-8")
    computer.processes = [Process(f"java net.minecraft.client.main.Main --gameDir {own} --version 1.20.1")]
    found = rows(computer.examined(no_window))
    assert found["options.txt"].detail == f"the game that runs: {own / 'options.txt'}"
    assert found["autoJump"].status == "fail"


def test_reduced_debug_info_in_options_txt_fails_its_row_only_if_no_debug_screen_is_seen(computer: Computer) -> None:
    computer.options.write_text(GOOD.replace("reducedDebugInfo:false", "reducedDebugInfo:true"), "utf-8")
    assert statuses(computer.examined(no_window))["reduced debug info"] == "fail"
    assert statuses(computer.examined(opened(client_in(as_it_was))))["reduced debug info"] == "pass"


def test_unreadable_options_txt_fails_its_row_and_the_option_rows_are_skipped(computer: Computer) -> None:
    computer.options.write_bytes(b"\x89PNG\r\n\0\0")
    found = rows(computer.examined(no_window))
    assert found["options.txt"].status == "fail"
    assert found["options.txt"].detail == "doesn't hold the game's options"
    assert found["autoJump"].status == "skip"


class Interrupted:
    """A window that is closed, or a person's Ctrl+C, at the look number ``at``."""

    def __init__(self, client: VirtualClient, at: int, error: BaseException) -> None:
        self._client, self._left, self._error = client, at, error

    def _look(self) -> None:
        self._left -= 1
        if self._left < 0:
            raise self._error

    def size(self) -> tuple[int, int]:
        self._look()
        return self._client.display.size()

    def title(self) -> str:
        self._look()
        return self._client.display.title()

    def is_in_front(self) -> bool:
        self._look()
        return self._client.display.is_in_front()

    def grab(self, region: Region | None = None) -> Frame:
        self._look()
        return self._client.display.grab(region)


def interrupted(
    client: VirtualClient, at: int, error: BaseException
) -> Callable[[str], AbstractContextManager[Devices]]:
    @contextmanager
    def open_devices(_title: str) -> Iterator[Devices]:
        interrupted = Interrupted(client, at, error)
        yield Devices(interrupted, client.keyboard, client.pointer, client.clock, client.clipboard)

    return open_devices


@given(at=st.integers(0, 60))
def test_window_that_closes_at_any_moment_still_gives_every_row_and_leaves_no_key_down(
    at: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    computer, client = Computer(tmp_path_factory.mktemp("home")), client_in(as_it_was)
    closed = DesktopError("the window 'Minecraft 1.20.1' has closed: start the game again")
    found = computer.examined(interrupted(client, at, closed))
    assert tuple(statuses(found)) == tuple(CheckName)
    assert not client.window.down
    told = [check for check in found.checks if "has closed" in check.detail]
    assert len(told) == (0 if statuses(found)["input"] == "pass" else 1)


@given(at=st.integers(0, 40))
def test_ctrl_c_at_any_moment_leaves_no_key_down_and_every_file_as_it_was(
    at: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    computer, client = Computer(tmp_path_factory.mktemp("home")), client_in(as_it_was)
    before = {file: file.read_bytes() for file in computer.system.home.rglob("*") if file.is_file()}
    client.clipboard.write("a person's text")
    with suppress(KeyboardInterrupt):
        computer.examined(interrupted(client, at, KeyboardInterrupt()), clipboard=client.clipboard)
    assert not client.window.down
    assert client.clipboard.read() == "a person's text"
    assert {file: file.read_bytes() for file in computer.system.home.rglob("*") if file.is_file()} == before
