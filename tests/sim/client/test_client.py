import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Clipboard, Clock, Display, Keyboard, Pointer, Region
from mc_nested.live.model.reading import Reading
from scripts.benches.walked import displacement
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState, menu
from sim.client.settings import gui_scale
from tests.sim.client.f3_lines import left_lines, right_lines
from tests.sim.client.playing import TAP_S, arena_of, click, command, read, tap


def screen_of(client: VirtualClient) -> str:
    return client.game.screen


def click_button(client: VirtualClient, label: str) -> None:
    width, height = client.window.size
    size = -(-width // client.scale), -(-height // client.scale)
    buttons = menu(client.game.view().menu, client.edition, *size).buttons
    (found,) = [button for button in buttons if button.label == label]
    click(client, *found.middle)


def test_the_clients_devices_fit_the_device_protocols() -> None:
    client = VirtualClient()
    display: Display = client.display
    keyboard: Keyboard = client.keyboard
    pointer: Pointer = client.pointer
    clipboard: Clipboard = client.clipboard
    clock: Clock = client.clock
    assert all((display, keyboard, pointer, clipboard, clock))
    assert display.size() == (854, 480)


@pytest.mark.parametrize(
    ("version", "title"), [("1.12.2", "Minecraft 1.12.2"), ("1.20.1", "Minecraft 1.20.1 - Singleplayer")]
)
def test_the_title_says_the_version_and_since_1_15_the_state(version: str, title: str) -> None:
    client = VirtualClient(version=version)
    assert client.display.title() == title
    client.game.open("title")
    assert client.display.title() == f"Minecraft {version}"


@given(st.integers(0, 1000), st.integers(1, 12))
def test_a_hold_is_felt_for_its_ticks_or_one_more_or_less(seed: int, held: int) -> None:
    client = VirtualClient(seed=seed)
    client.clock.sleep(0.1)
    client.keyboard.press("w")
    client.clock.sleep(held * TAP_S)
    client.keyboard.release("w")
    client.clock.sleep(1.5)
    way = client.realm.player.feet[2] - 0.5
    assert any(way == pytest.approx(displacement(ticks, "walk"), abs=1e-6) for ticks in (held - 1, held, held + 1))


def test_a_short_hold_at_ten_frames_a_second_is_felt_for_none_or_two_ticks() -> None:
    client = VirtualClient(fps=10.0, input_latency_s=(0.0, 0.0))
    for _ in range(8):
        client.clock.sleep(0.5)
        before = client.realm.player.feet[2]
        client.keyboard.press("w")
        client.clock.sleep(TAP_S)
        client.keyboard.release("w")
        client.clock.sleep(1.5)
        way = client.realm.player.feet[2] - before
        assert any(way == pytest.approx(displacement(ticks, "walk"), abs=1e-6) for ticks in (0, 2))


@pytest.mark.parametrize("fps", [10.0, 20.0, 30.0])
def test_a_key_pressed_and_released_between_two_frames_does_not_move_the_player(fps: float) -> None:
    client = VirtualClient(fps=fps, input_latency_s=(0.001, 0.001))
    for _ in range(8):
        began = client.game.ticks
        while client.game.ticks == began:
            client.clock.sleep(0.001)
        client.keyboard.press("w")
        client.clock.sleep(0.8 / fps)
        client.keyboard.release("w")
        client.clock.sleep(0.5 + 0.013)
    assert client.realm.player.feet == (0.5, 64.0, 0.5)


@pytest.mark.parametrize(("fps", "steps"), [(10.0, {0, 2}), (20.0, {0, 1}), (60.0, {0, 1})])
def test_each_frame_runs_all_ticks_that_are_due(fps: float, steps: set[int]) -> None:
    client = VirtualClient(fps=fps)
    seen, ticks = set(), client.game.ticks
    for _ in range(4000):
        client.clock.sleep(0.0005)
        seen.add(client.game.ticks - ticks)
        ticks = client.game.ticks
    assert seen == steps
    assert abs(ticks - 40) <= 2


def test_sneaking_is_slower_and_lowers_the_eyes() -> None:
    client = VirtualClient(pitch=65.0)
    for key in ("left.shift", "w"):
        client.keyboard.press(key)
    client.clock.sleep(0.5)
    assert 0 < client.realm.player.feet[2] - 0.5 <= displacement(11, "sneak")
    assert client.realm.eye()[1] == 65.27


def actions() -> st.SearchStrategy[list[tuple[str, float]]]:
    keys = st.sampled_from(["w", "a", "s", "d", "t", "e", "esc", "1", "f3", "left.shift", "right", "left", "enter"])
    return st.lists(st.tuples(keys, st.floats(0.0, 0.4)), max_size=25)


@given(st.integers(0, 99), actions(), st.booleans())
def test_the_same_seed_and_the_same_events_give_the_same_pictures(
    seed: int, chosen: list[tuple[str, float]], has_mishaps: bool
) -> None:
    clients = [VirtualClient(seed=seed, size=(640, 480)) for _ in range(2)]
    pictures = []
    for client in clients:
        if has_mishaps:
            client.mishaps.every(2.0)
        for key, seconds in chosen:
            if key in ("right", "left"):
                client.pointer.press("right" if key == "right" else "left")
            else:
                client.keyboard.press(key)
            client.clock.sleep(seconds)
            client.keyboard.release(key)
        pictures.append(client.display.grab())
    one, other = clients
    assert one.mishaps.happened == other.mishaps.happened
    assert one.realm.player == other.realm.player
    assert np.array_equal(pictures[0], pictures[1])


def test_a_picture_is_at_most_30_ms_and_a_frame_old() -> None:
    for seed in range(20):
        client = VirtualClient(seed=seed)
        client.clock.sleep(0.2)
        client.keyboard.press("w")
        moved_at = None
        while moved_at is None:
            client.clock.sleep(0.0005)
            if client.realm.player.feet[2] > 0.5:
                moved_at = client.clock.now()
        while read(client).xyz == (0.5, 64.0, 0.5):
            pass
        assert 0.0 < client.clock.now() - moved_at < 0.030 + 1 / 60 + 0.002


def test_an_older_picture_never_follows_a_newer_one() -> None:
    client = VirtualClient(seed=4, size=(640, 480), scale=1)
    client.keyboard.press("w")
    seen = []
    for _ in range(150):
        reading = read(client)
        assert reading.xyz is not None
        seen.append(reading.xyz[2])
        client.clock.sleep(0.002)
    assert seen == sorted(seen)
    assert len(set(seen)) > 5


@given(st.integers(-50, 900), st.integers(-50, 500), st.integers(1, 900), st.integers(1, 500), st.integers(0, 5))
def test_a_region_is_that_part_of_the_whole_picture(left: int, top: int, width: int, height: int, moves: int) -> None:
    client, other = VirtualClient(seed=1), VirtualClient(seed=1)
    for each in (client, other):
        each.clock.sleep(0.2)
    for _ in range(moves):
        client.display.grab(Region(left, top, width, height))
        other.display.grab()
        for each in (client, other):
            each.keyboard.press("w")
            each.clock.sleep(0.15)
    part = client.display.grab(Region(left, top, width, height))
    whole = other.display.grab()
    rows, columns = slice(max(0, top), max(0, top + height)), slice(max(0, left), max(0, left + width))
    assert part.size == whole[rows, columns].size
    assert not part.size or np.array_equal(part, whole[rows, columns])


def test_letters_typed_before_the_chat_is_open_count_as_game_keys() -> None:
    client = VirtualClient(seed=2)
    client.keyboard.press("t")
    client.keyboard.type("5")
    client.keyboard.release("t")
    client.clock.sleep(0.2)
    assert client.realm.player.slot == 4
    assert client.game.chat.typed == ""
    client.keyboard.type("/time set 6000")
    client.clock.sleep(0.1)
    assert client.game.chat.typed == "/time set 6000"


def test_a_command_is_typed_sent_and_answered_on_the_screen() -> None:
    client = VirtualClient(version="1.16.5")
    command(client, "/tp @s 5.5 64 7.5 90 65")
    assert screen_of(client) == "world"
    assert client.realm.player.feet == (5.5, 64.0, 7.5)
    assert [line.text for line in client.game.view().chat] == ["Teleported Player to 5.500000, 64.000000, 7.500000"]


def test_a_command_can_be_pasted_over_selected_text() -> None:
    client = VirtualClient()
    client.clipboard.write("/time set 1")
    tap(client, "/")
    assert client.game.chat.typed == "/"
    tap(client, "left.control", "a")
    tap(client, "left.control", "v")
    assert client.game.chat.typed == "/time set 1"
    tap(client, "backspace")
    assert client.game.chat.typed == "/time set "
    tap(client, "esc")
    assert screen_of(client) == "world"


def test_f3_toggles_on_release_unless_it_was_part_of_a_combination() -> None:
    client = VirtualClient(feet=(1.234, 64.0, -5.678), yaw=370.0, pitch=12.345)
    tap(client, "f3")
    assert not client.game.has_f3
    tap(client, "f3", "c")
    assert not client.game.has_f3
    assert client.clipboard.read() == "/execute in minecraft:overworld run tp @s 1.23 64.00 -5.68 370.00 12.35"
    assert client.game.view().chat[0].text == "[Debug]: Copied location to clipboard"
    tap(client, "f3", "d")
    assert client.game.view().chat == ()
    tap(client, "f3")
    assert client.game.has_f3


def test_f3_and_c_copies_no_location_in_1_12_or_with_reduced_debug_info() -> None:
    old = VirtualClient(version="1.12.2")
    reduced = VirtualClient()
    reduced.realm.rules["reducedDebugInfo"] = "true"
    for client in (old, reduced):
        tap(client, "f3", "c")
        assert client.clipboard.read() == ""
    assert "reduced" in (read(reduced).problem or "")


@pytest.mark.parametrize("version", ["1.12.2", "1.14.4", "1.20.1", "26.1"])
def test_clicks_lead_from_the_world_to_the_title_and_back(version: str) -> None:
    client = VirtualClient(version=version)
    tap(client, "esc")
    assert screen_of(client) == "pause"
    click_button(client, "Save and Quit to Title")
    client.clock.sleep(1.5)
    assert screen_of(client) == "title"
    click_button(client, "Singleplayer")
    click_button(client, "Play Selected World")
    assert screen_of(client) == "worlds"
    click(client, client.window.size[0] / client.scale / 2, 60)
    click_button(client, "Play Selected World")
    client.clock.sleep(2.5)
    assert screen_of(client) == "world"
    client.clock.sleep(0.3)
    assert read(client).problem is None


def test_a_world_is_entered_by_a_double_click_or_a_click_on_its_picture() -> None:
    for places in (((213, 60), (213, 60)), ((90, 60),)):
        client = VirtualClient()
        client.game.open("worlds")
        for x, y in places:
            client.pointer.move(2 * x, 2 * y)
            client.pointer.press("left")
            client.clock.sleep(0.03)
            client.pointer.release("left")
            client.clock.sleep(0.05)
        assert screen_of(client) == "loading"


def test_the_death_screens_buttons_wait_for_a_second() -> None:
    client = VirtualClient()
    client.game.die()
    click_button(client, "Respawn")
    assert screen_of(client) == "death"
    tap(client, "esc")
    client.clock.sleep(1.0)
    assert screen_of(client) == "death"
    click_button(client, "Respawn")
    assert screen_of(client) == "world"


def test_while_the_game_holds_the_mouse_moving_it_turns_the_view() -> None:
    client = VirtualClient(size=(854, 480), pitch=0.0)
    assert client.pointer.position() == (427, 240)
    client.pointer.move(427 + 100, 240 + 20)
    client.clock.sleep(0.1)
    assert (client.realm.player.yaw, client.realm.player.pitch) == (15.0, 3.0)
    assert client.pointer.position() == (427, 240)
    tap(client, "esc")
    client.pointer.move(10, 20)
    assert client.pointer.position() == (10, 20)


def test_a_key_pressed_behind_another_window_never_reaches_the_game() -> None:
    client = VirtualClient(options=GameOptions(pause_on_lost_focus=False))
    client.keyboard.press("w")
    client.clock.sleep(0.2)
    client.set_front(is_in_front=False)
    assert not client.display.is_in_front()
    client.keyboard.press("a")
    client.keyboard.release("w")
    client.clock.sleep(2.0)
    assert [stray.name for stray in client.window.strays] == ["a"]
    assert client.window.down == {"a"}
    before = client.realm.player.feet
    client.set_front(is_in_front=True)
    client.clock.sleep(1.0)
    assert client.realm.player.feet == before
    assert before[0] == 0.5


@pytest.mark.parametrize(("seconds", "screen"), [(0.4, "world"), (0.6, "pause")])
def test_the_game_pauses_after_half_a_second_without_the_focus(seconds: float, screen: str) -> None:
    client = VirtualClient()
    client.set_front(is_in_front=False)
    client.clock.sleep(seconds)
    client.set_front(is_in_front=True)
    client.clock.sleep(1.0)
    assert screen_of(client) == screen


def test_f3_and_p_let_the_game_run_on_without_the_focus() -> None:
    client = VirtualClient()
    tap(client, "f3", "p")
    client.set_front(is_in_front=False)
    client.clock.sleep(1.0)
    assert screen_of(client) == "world"


def test_a_world_folder_is_written_on_leaving_and_read_on_entering(tmp_path: Path) -> None:
    client = VirtualClient(world_folder=tmp_path / "world")
    client.realm.player.hotbar[2] = Stack("stone", 5)
    client.realm.player.slot = 2
    client.realm.player.look(90.0, 65.0)
    client.realm.rules["doDaylightCycle"] = "false"
    client.realm.world.put((0, 64, 3), "stone")
    client.game.do("leave")
    client.clock.sleep(1.5)
    other = VirtualClient(world_folder=tmp_path / "world")
    other.game.open("loading")
    other.clock.sleep(2.2)
    assert other.built == {(0, 64, 3): "stone"}
    assert other.realm.player == client.realm.player
    assert other.realm.rules == client.realm.rules


def test_the_client_knows_the_true_cell_and_the_blocks_in_the_arena() -> None:
    client = VirtualClient()
    arena = arena_of(client, "west")
    client.realm.player.go_to(arena.centre_of((3, 9)))
    client.realm.world.put(arena.block_of((4, 9)), "stone")
    client.realm.world.put((500, 64, 500), "stone")
    assert client.cell(arena) == (3, 9)
    assert client.placed(arena) >= {(4, 9)}
    assert len(client.built) == 2


def test_the_automatic_gui_scale_is_the_largest_that_fits_and_limits_all_others() -> None:
    assert [gui_scale((854, 480), wanted) for wanted in range(5)] == [2, 1, 2, 2, 2]
    assert gui_scale((1920, 1080), 0) == 4
    assert gui_scale((300, 200), 0) == 1


def test_a_resized_window_is_read_at_its_new_scale() -> None:
    client = VirtualClient(scale=0)
    client.resize((1280, 720))
    client.clock.sleep(0.1)
    assert client.scale == 3
    assert client.display.grab().shape == (720, 1280, 3)
    assert read(client).problem is None


@pytest.mark.parametrize(("choices", "fps"), [({"fps": 59.94}, 60), ({"fps": 20.0, "shown_fps": 144.0}, 144)])
def test_the_debug_screen_says_the_clients_frames_and_size(choices: dict[str, Any], fps: int) -> None:
    client = VirtualClient(version="1.20.1", size=(1023, 767), **choices)
    client.clock.sleep(1.0)
    for size in ((1023, 767), (1280, 720)):
        client.resize(size)
        client.clock.sleep(0.2)
        screen = client.display.seen().f3
        assert screen is not None
        assert left_lines(screen)[1].text.startswith(f"{fps} fps T: {fps} vsync")
        assert f"Display: {size[0]}x{size[1]} (AMD)" in [line.text for line in right_lines(screen)]


def test_settings_are_taken_by_name_and_never_change() -> None:
    client = VirtualClient(seed=7, version="1.12.2")
    assert (client.settings.seed, client.settings.version) == (7, "1.12.2")
    with pytest.raises(dataclasses.FrozenInstanceError):
        client.settings.seed = 8  # type: ignore[misc]
    with pytest.raises(TypeError, match="colour"):
        VirtualClient(colour="red")


def test_the_title_screen_is_read_as_having_no_debug_screen() -> None:
    client = VirtualClient()
    client.game.open("title")
    client.clock.sleep(0.2)
    assert isinstance(read(client), Reading)
    assert read(client).problem is not None
    assert menu(MenuState("title"), client.edition, 427, 240).buttons
