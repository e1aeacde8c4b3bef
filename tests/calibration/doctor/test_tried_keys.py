"""Keys that the doctor tries in a virtual game: whichever moves the player, and the frame of the hotbar's slot."""

import math

import pytest

from calibration.doctor.snapshot import take_snapshot
from calibration.doctor.tried_keys import TriedWindow, is_slot_seen_to_change, moving_key
from mc_nested.errors import NotInFrontError, WrongScreenError
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import InputTable, KeysTable
from mc_nested.live.vision.font import font_of
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from tests.calibration.contexts import started


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


def test_how_far_the_step_was_not_undone_is_measured() -> None:
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
def test_the_slots_frame_is_seen_at_every_scale_and_in_windows_whose_size_it_does_not_divide(
    size: tuple[int, int], scale: int
) -> None:
    client = started(VirtualClient(size=size, scale=scale))
    assert is_slot_seen_to_change(window_of(client), KeysTable())
    assert not is_slot_seen_to_change(window_of(client), KeysTable(hotbar=("i", "j", *"3456789")))


def test_another_slot_than_the_first_two_is_a_wrong_profile() -> None:
    client = started(VirtualClient())
    assert not is_slot_seen_to_change(window_of(client), KeysTable(hotbar=tuple("132456789")))


def test_in_a_menu_nothing_is_pressed() -> None:
    client = started(VirtualClient())
    client.game.open("pause")
    client.clock.sleep(0.3)
    for trial in (moving_key, is_slot_seen_to_change):
        with pytest.raises(WrongScreenError, match="a menu opened"):
            trial(window_of(client), KeysTable())


def test_behind_another_window_nothing_is_pressed() -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    for trial in (moving_key, is_slot_seen_to_change):
        with pytest.raises(NotInFrontError):
            trial(window_of(client), KeysTable())
    assert client.window.strays == []
