"""The rehearsal in a real GLFW window on a display of its own: what other programs see of it, and can do to it."""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows of an X server", allow_module_level=True)

from Xlib import X
from Xlib.display import Display
from Xlib.ext import xtest
from Xlib.protocol import event

from mc_nested.live.devices import Frame
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines
from scripts.programs import ROOT
from scripts.rehearsal_window import START_S, RehearsalWindow, open_rehearsal
from scripts.window_display import open_display
from tests.sim.client.playing import FONT

pytestmark = pytest.mark.window

W_PLACE, TWO_PLACE, RIGHT_SHIFT, ESC, F3, C = 25, 11, 62, 9, 69, 54
"""Keycodes of an X server: 8 more than Linux's own."""

SOON_S = 5.0


class Played:
    """A rehearsal and a connection to its display, as a person's hands and eyes have them."""

    def __init__(self, rehearsal: RehearsalWindow, display: Display) -> None:
        self.rehearsal, self.display = rehearsal, display
        self.window = self.display.screen().root.query_tree().children[-1]

    def key(self, code: int, *, is_down: bool) -> None:
        xtest.fake_input(self.display, X.KeyPress if is_down else X.KeyRelease, code)
        self.display.sync()

    def tap(self, code: int) -> None:
        self.key(code, is_down=True)
        self.key(code, is_down=False)

    def picture(self) -> Frame:
        size = self.window.get_geometry()
        image = self.window.get_image(0, 0, size.width, size.height, X.ZPixmap, 0xFFFFFFFF)
        pixels = np.frombuffer(image.data, np.uint8).reshape(size.height, size.width, 4)
        return np.ascontiguousarray(pixels[:, :, :3])

    def close(self) -> None:
        """Ask the window to close, as a window manager does."""
        protocols, delete = (self.display.intern_atom(name) for name in ("WM_PROTOCOLS", "WM_DELETE_WINDOW"))
        message = event.ClientMessage(
            window=self.window, client_type=protocols, data=(32, [delete, X.CurrentTime, 0, 0, 0])
        )
        self.window.send_event(message)
        self.display.sync()


def soon(is_so: Callable[[], bool], patience_s: float = SOON_S) -> bool:
    """Return whether it comes true before long."""
    end = time.monotonic() + patience_s
    while not is_so():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


@contextmanager
def connected(env: dict[str, str]) -> Iterator[Display]:
    display = Display(env["DISPLAY"])
    try:
        yield display
    finally:
        display.close()


def is_game(window: Any) -> bool:
    """Return whether a window has the game's title. GLFW has an invisible one beside it, without a title."""
    return str(window.get_wm_name() or "").startswith("Minecraft")


@pytest.fixture
def played(display: dict[str, str], tmp_path: Path) -> Iterator[Played]:
    with open_rehearsal(display, tmp_path) as rehearsal, connected(display) as connection:
        yield Played(rehearsal, connection)


def test_the_debug_screen_is_read_in_the_rehearsals_window(played: Played) -> None:
    for size in ((854, 480), (959, 717)):
        played.window.configure(width=size[0], height=size[1])
        played.display.sync()

        def is_read(size: tuple[int, int] = size) -> bool:
            picture = played.picture()
            reading = read_debug_screen(picture, FONT, Overlay(2, VANILLA, (224, 224, 224)))
            return picture.shape == (size[1], size[0], 3) and reading.xyz == (0.5, 64.0, 0.5)

        assert soon(is_read)


def test_the_rehearsals_debug_screen_names_its_own_frames_and_size(tmp_path: Path, display: dict[str, str]) -> None:
    with open_rehearsal(display, tmp_path, "--fps", "37") as rehearsal, connected(display) as connection:
        hands = Played(rehearsal, connection)
        for size in ((854, 480), (1023, 767)):
            hands.window.configure(width=size[0], height=size[1])
            hands.display.sync()

            def is_said(size: tuple[int, int] = size) -> bool:
                found = find_debug_screen(hands.picture(), FONT)
                lines = ScreenLines(found.dots, FONT, found.overlay) if found else None
                said = ("37 fps T: 37 ", f"Display: {size[0]}x{size[1]} (AMD)")
                return lines is not None and all(lines.holds(text) for text in said)

            assert soon(is_said)


def test_keys_are_taken_by_their_places_under_any_layout(tmp_path: Path, window_programs: None) -> None:  # noqa: ARG001
    for layout in ("fr", "ru"):
        with (
            open_display(layout=layout) as env,
            open_rehearsal(env, tmp_path) as rehearsal,
            connected(env) as connection,
        ):
            hands = Played(rehearsal, connection)
            hands.key(W_PLACE, is_down=True)
            assert soon(lambda: rehearsal.truth.now()["keys_down"] == ["w"])
            assert soon(lambda: rehearsal.truth.now()["feet"][2] > 1)
            hands.key(W_PLACE, is_down=False)
            assert soon(lambda: rehearsal.truth.now()["keys_down"] == [])


def test_up_to_1_12_keys_are_taken_by_what_the_layout_makes(tmp_path: Path, window_programs: None) -> None:  # noqa: ARG001
    with (
        open_display(layout="fr") as env,
        open_rehearsal(env, tmp_path, "--version", "1.12.2") as rehearsal,
        connected(env) as connection,
    ):
        hands = Played(rehearsal, connection)

        def are_down(*keys: str) -> bool:
            return soon(lambda: rehearsal.truth.now()["keys_down"] == [*keys])

        hands.key(W_PLACE, is_down=True)
        assert are_down("z")
        hands.key(W_PLACE, is_down=False)
        assert are_down()
        for code in (RIGHT_SHIFT, TWO_PLACE):
            hands.key(code, is_down=True)
        assert are_down("2", "right.shift")
        for code in (TWO_PLACE, RIGHT_SHIFT):
            hands.key(code, is_down=False)
        assert are_down()


def test_the_mouse_turns_the_view_in_the_world_and_moves_freely_in_a_menu(played: Played) -> None:
    truth = played.rehearsal.truth
    for _ in range(2):  # the first movement after the game has taken the mouse is lost
        xtest.fake_input(played.display, X.MotionNotify, 1, X.CurrentTime, X.NONE, 20, 0)
        played.display.sync()
        time.sleep(0.2)
    assert truth.now()["yaw"] == pytest.approx(20 * 0.15)
    played.tap(ESC)
    assert soon(lambda: truth.now()["screen"] == "pause")
    for x, y in ((10, 20), (300, 200)):
        xtest.fake_input(played.display, X.MotionNotify, 0, X.CurrentTime, X.NONE, x, y)
        played.display.sync()
        pointer = played.display.screen().root.query_pointer()
        assert (pointer.root_x, pointer.root_y) == (x, y)
    assert truth.now()["yaw"] == pytest.approx(20 * 0.15)


def test_f3_and_c_copies_to_the_real_clipboard(played: Played, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", played.rehearsal.env["DISPLAY"])
    from mc_nested.live.desktop import this_system

    open_clipboard = this_system().open_clipboard

    played.key(F3, is_down=True)
    played.tap(C)
    played.key(F3, is_down=False)
    assert soon(lambda: open_clipboard().read().startswith("/execute in minecraft:overworld run tp @s 0.50 64.00 0.50"))


def test_a_rehearsal_ends_when_its_window_is_closed(played: Played) -> None:
    played.close()
    assert played.rehearsal.process.wait(SOON_S) == 0


def test_a_terminated_rehearsal_says_in_one_line_that_it_stopped(played: Played) -> None:
    played.rehearsal.process.terminate()
    assert played.rehearsal.process.wait(SOON_S) == 128 + 15
    assert played.rehearsal.log.read_text().splitlines()[-1] == "mc-nested: stopped"


def test_a_second_rehearsal_window_is_refused(played: Played, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    with pytest.raises(RuntimeError, match="a window of Minecraft, or another rehearsal, is open: close it first"):
        open_rehearsal(played.rehearsal.env, other).__enter__()


def test_only_one_of_two_rehearsals_started_at_the_same_moment_opens(display: dict[str, str], tmp_path: Path) -> None:
    env = {**display, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "mc_nested.cli", "rehearse"]
    both = [
        subprocess.Popen(command, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    try:
        assert soon(lambda: any(process.poll() is not None for process in both), START_S)
        (refused,) = (process for process in both if process.poll() is not None)
        assert refused.returncode == 2
        assert refused.stderr is not None
        assert refused.stderr.read() == (
            "mc-nested: a window of Minecraft, or another rehearsal, is open: close it first\n"
        )
        with connected(display) as connection:
            root = connection.screen().root
            assert soon(lambda: any(is_game(child) for child in root.query_tree().children), START_S)
        (opened,) = (process for process in both if process is not refused)
        assert opened.poll() is None
        opened.kill()
        opened.wait()
        # Its place is free again, though it could not tidy up.
        with open_rehearsal(display, tmp_path) as another:
            assert another.process.poll() is None
    finally:
        for process in both:
            process.kill()
            process.communicate()


def test_a_display_without_opengl_is_a_one_line_error(tmp_path: Path, window_programs: None) -> None:  # noqa: ARG001
    with (
        open_display(has_opengl=False) as env,
        pytest.raises(RuntimeError, match=r"this display offers no OpenGL 3\.3"),
    ):
        open_rehearsal(env, tmp_path).__enter__()


def test_a_minimised_window_plays_on_when_it_is_brought_back(tmp_path: Path, window_programs: None) -> None:  # noqa: ARG001
    with (
        open_display(has_window_manager=True) as env,
        open_rehearsal(env, tmp_path) as rehearsal,
        connected(env) as root,
    ):
        (number,) = root.screen().root.get_full_property(root.intern_atom("_NET_CLIENT_LIST"), X.AnyPropertyType).value
        window = root.create_resource_object("window", number)
        change = root.intern_atom("WM_CHANGE_STATE")
        message = event.ClientMessage(window=window, client_type=change, data=(32, [3, 0, 0, 0, 0]))
        root.screen().root.send_event(message, X.SubstructureRedirectMask | X.SubstructureNotifyMask)
        root.sync()
        assert soon(lambda: not rehearsal.truth.now()["is_in_front"])
        window.map()
        root.sync()
        assert soon(lambda: bool(rehearsal.truth.now()["is_in_front"]))
        assert rehearsal.process.poll() is None
