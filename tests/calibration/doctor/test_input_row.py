"""The checks of input: a step, a slot and the debug screen, each seen and undone, and only in the world.

The clipboard is tried out, and holds afterwards what it held.
"""

import math
import re

import pytest

from calibration.doctor.check import Check
from calibration.doctor.input_row import (
    PROBE,
    TriedWindow,
    clipboard_row,
    input_row,
    is_slot_seen_to_change,
    moving_key,
)
from calibration.doctor.snapshot import WindowSnapshot, take_snapshot
from mc_nested.errors import DesktopError, NotInFrontError, WrongScreenError
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.debug_entries import target_entry
from mc_nested.live.profile.tables import InputTable, KeysTable
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.debug_entries import GAME_DEFAULT, DebugEntries
from tests.calibration.contexts import started


@pytest.fixture
def client() -> VirtualClient:
    return started(VirtualClient())


def tried(client: VirtualClient, keys: KeysTable | None = None, *, opens_menu_at: int = 999) -> Check:
    font, taken = font_of(drawn_atlas()), 0

    def snapshot() -> WindowSnapshot:
        nonlocal taken
        taken += 1
        if taken == opens_menu_at:
            client.game.open("pause")
            client.clock.sleep(0.1)
        return take_snapshot(client.devices, font)

    with InputController(client.devices, InputTable()) as controller:
        return input_row(client.devices, controller, snapshot, keys or KeysTable())


def test_input_row_tries_a_step_a_slot_and_the_debug_screen_and_undoes_them(client: VirtualClient) -> None:
    player = client.game.realm.player
    player.slot, before = 4, player.feet
    row = tried(client)
    assert row.status == "pass"
    found = re.fullmatch(r"w, 1, 2 and f3 pressed, and seen, f3 after (\d+) ms; .*undone.*", row.detail)
    assert found
    assert 10 < int(found[1]) < 500
    assert client.game.has_f3
    client.clock.sleep(0.3)
    assert player.slot == 4
    assert math.dist(player.feet, before) < 0.15
    assert not client.window.down


@pytest.mark.parametrize("version", ["1.21.10", "26.3", "26.4"])
def test_an_entry_that_is_always_shown_does_not_count_as_the_debug_screen(version: str) -> None:
    entries: DebugEntries = {**GAME_DEFAULT, target_entry(version): "alwaysOn"}
    client = started(VirtualClient(version=version, pitch=65.0, debug_entries=entries))
    assert tried(client).status == "pass"
    assert client.game.has_f3


def test_input_row_says_how_many_blocks_of_the_step_were_not_undone(client: VirtualClient) -> None:
    before = client.game.realm.player.feet
    row = tried(client, KeysTable(back="i"))
    left = re.search(r"; undone but for (\d\.\d\d) blocks of the step$", row.detail)
    assert left
    client.clock.sleep(0.5)
    assert float(left[1]) == pytest.approx(math.dist(client.game.realm.player.feet, before), abs=0.006)


@pytest.mark.parametrize("lag_s", [0.25, 0.5])
def test_input_row_passes_in_a_lagging_game_and_gives_the_distance_left(lag_s: float) -> None:
    lag = (lag_s, lag_s)
    client = started(VirtualClient(input_latency_s=lag, capture_latency_s=lag))
    client.clock.sleep(2 * lag_s)
    before = client.game.realm.player.feet
    row = tried(client)
    assert row.status == "pass"
    client.clock.sleep(2 * lag_s)
    left = re.search(r"; undone but for (\d\.\d\d) blocks of the step$", row.detail)
    said = float(left[1]) if left else 0.0
    assert said == pytest.approx(math.dist(client.game.realm.player.feet, before), abs=0.05)


@pytest.mark.parametrize("slot", range(9))
def test_input_row_selects_the_earlier_hotbar_slot_again(client: VirtualClient, slot: int) -> None:
    client.game.realm.player.slot = slot
    client.clock.sleep(0.3)
    assert tried(client).status == "pass"
    client.clock.sleep(0.3)
    assert client.game.realm.player.slot == slot


def test_debug_key_is_not_pressed_if_no_movement_key_has_an_effect(client: VirtualClient) -> None:
    row = tried(client, KeysTable(forward="i", back="k", left="j"))
    assert (row.status, row.detail) == (
        "fail",
        "i, k and j were pressed with left.shift, and the player stayed where it was",
    )
    assert "input method" in row.fix
    assert client.game.has_f3


def test_input_row_passes_with_the_back_key_if_the_forward_key_moves_nothing(client: VirtualClient) -> None:
    row = tried(client, KeysTable(forward="i"))
    assert row.status == "pass"
    assert row.detail.startswith("s, 1, 2 and f3")


def test_unchanged_hotbar_slot_is_a_warning_and_leaves_the_debug_screen_on(client: VirtualClient) -> None:
    row = tried(client, KeysTable(hotbar=("i", "j", *"3456789")))
    assert (row.status, row.detail) == ("warn", "i and j were pressed, and the hotbar's frame wasn't seen to move")
    assert client.game.has_f3


def test_debug_key_without_an_effect_fails_the_input_row(client: VirtualClient) -> None:
    row = tried(client, KeysTable(debug="f10"))
    assert row.status == "fail"
    assert row.detail == "f10 was pressed, and the debug screen stayed on"


@pytest.mark.parametrize("screen", ["pause", "chat", "title"])
def test_on_another_screen_nothing_is_pressed(client: VirtualClient, screen: str) -> None:
    client.game.open(screen)  # type: ignore[arg-type]
    client.clock.sleep(0.3)
    assert tried(client).status == "skip"
    assert client.game.screen == screen


def test_behind_another_window_nothing_is_pressed(client: VirtualClient) -> None:
    client.set_front(is_in_front=False)
    row = tried(client)
    assert (row.status, row.detail) == ("skip", "another window is in front, so nothing is pressed")
    assert client.game.has_f3


def test_menu_that_opens_during_the_input_check_is_a_warning(client: VirtualClient) -> None:
    row = tried(client, opens_menu_at=2)
    assert (row.status, row.detail) == ("warn", "a menu opened meanwhile")


class Board:
    """A clipboard that goes wrong at its call number ``fails_at``, and may keep what others write to itself."""

    def __init__(self, text: str = "mine", fails_at: int = 99, *, is_kept: bool = False) -> None:
        self.text, self.left, self.is_kept = text, fails_at, is_kept

    def _call(self) -> None:
        self.left -= 1
        if self.left == 0:
            raise DesktopError("the clipboard holds something else than text: copy any text, start again")

    def read(self) -> str:
        self._call()
        return self.text

    def write(self, text: str) -> None:
        self._call()
        if not self.is_kept:
            self.text = text


def test_clipboard_row_passes_and_keeps_the_clipboards_text() -> None:
    board = Board("a person's text")
    assert clipboard_row(board).status == "pass"
    assert board.text == "a person's text"
    assert clipboard_row(Board("")).status == "pass"
    assert clipboard_row(None).status == "skip"


def test_a_clipboard_that_holds_a_picture_is_left_alone() -> None:
    board = Board("a picture", fails_at=1)
    row = clipboard_row(board)
    assert (row.status, row.detail) == ("warn", "the clipboard holds something else than text")
    assert board.text == "a picture"


@pytest.mark.parametrize("fails_at", [2, 3])
def test_clipboard_that_fails_midway_keeps_its_old_text(fails_at: int) -> None:
    board = Board(fails_at=fails_at)
    assert clipboard_row(board).status == "warn"
    assert board.text == "mine"
    assert board.text != PROBE


def test_a_clipboard_that_another_program_keeps_is_reported() -> None:
    assert clipboard_row(Board(is_kept=True)).detail == "what is written isn't what is read"


def window_of(client: VirtualClient) -> TriedWindow:
    font = font_of(drawn_atlas())
    controller = InputController(client.devices, InputTable())
    return TriedWindow(client.devices, controller, lambda: take_snapshot(client.devices, font))


@pytest.mark.parametrize(
    ("keys", "moved"),
    [(KeysTable(), "w"), (KeysTable(forward="i"), "s"), (KeysTable(forward="i", back="k"), "a")],
    ids=["forward", "back", "left"],
)
def test_the_first_movement_key_that_moves_the_player_is_named(keys: KeysTable, moved: str) -> None:
    step = moving_key(window_of(started(VirtualClient())), keys)
    assert step is not None
    assert step.key == moved
    assert 0.1 < step.seen_s < 0.5


def test_moving_key_measures_how_far_the_step_was_not_undone() -> None:
    client = started(VirtualClient())
    before = client.game.realm.player.feet
    step = moving_key(window_of(client), KeysTable(back="i"))
    assert step is not None
    assert step.off is not None
    assert step.off > 0.1
    client.clock.sleep(0.5)
    assert step.off == pytest.approx(math.dist(client.game.realm.player.feet, before), abs=0.002)


def test_without_a_key_that_moves_the_player_no_moving_key_is_named() -> None:
    client = started(VirtualClient())
    before = client.game.realm.player.feet
    assert moving_key(window_of(client), KeysTable(forward="i", back="k", left="j")) is None
    assert client.game.realm.player.feet == before


@pytest.mark.parametrize(("size", "scale"), [((640, 480), 1), ((854, 480), 2), ((1281, 721), 3)])
def test_change_of_hotbar_slot_is_seen_at_gui_scales_1_to_3(size: tuple[int, int], scale: int) -> None:
    client = started(VirtualClient(size=size, scale=scale))
    assert is_slot_seen_to_change(window_of(client), KeysTable())
    assert not is_slot_seen_to_change(window_of(client), KeysTable(hotbar=("i", "j", *"3456789")))


def test_change_of_hotbar_slot_is_not_seen_if_the_second_slots_key_selects_the_third() -> None:
    client = started(VirtualClient())
    assert not is_slot_seen_to_change(window_of(client), KeysTable(hotbar=tuple("132456789")))


def test_key_trials_in_a_menu_raise_an_error() -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    client.clock.sleep(0.3)
    for trial in (moving_key, is_slot_seen_to_change):
        with pytest.raises(WrongScreenError, match="a menu opened"):
            trial(window_of(client), KeysTable())


def test_no_key_is_tried_behind_another_window() -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    for trial in (moving_key, is_slot_seen_to_change):
        with pytest.raises(NotInFrontError):
            trial(window_of(client), KeysTable())
    assert client.window.strays == []
