import math

import numpy as np
import pytest

from scripts.benches.walked import displacement
from sim.client.client import VirtualClient
from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.window import VirtualWindow
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm, Stack
from sim.client.game.world import VirtualWorld
from sim.client.mishaps import DRAWN, KINDS, SIZES, Kind, Mishap, Mishaps
from tests.sim.client.playing import read, tap


def struck(kind: Kind) -> VirtualClient:
    client = VirtualClient(pitch=65.0)
    client.clock.sleep(0.2)
    client.mishaps.plan(kind, 0.1)
    client.clock.sleep(0.11)
    assert [mishap.kind for mishap in client.mishaps.happened] == [kind]
    return client


def test_the_focus_is_lost_and_comes_back() -> None:
    client = struck("lost_focus")
    assert not client.display.is_in_front()
    client.clock.sleep(2.5)
    assert client.display.is_in_front()


@pytest.mark.parametrize("kind", ["pause", "chat", "inventory", "death"])
def test_a_screen_opens_over_the_world(kind: Kind) -> None:
    assert struck(kind).game.screen == kind


def test_a_disconnect_shows_its_screen_and_removes_the_worlds_state_from_the_title() -> None:
    client = struck("disconnect")
    assert client.game.screen == "disconnected"
    assert client.display.title() == "Minecraft 1.20.1"


def test_a_frozen_picture_stays_while_the_game_goes_on() -> None:
    client = struck("frozen_frame")
    client.freeze(1.0)
    before = client.display.grab()
    client.keyboard.press("w")
    client.clock.sleep(0.8)
    assert client.realm.player.feet[2] > 2
    assert np.array_equal(client.display.grab(), before)
    client.clock.sleep(0.5)
    assert not np.array_equal(client.display.grab(), before)


def test_a_black_picture_lasts_half_a_second_at_most() -> None:
    client = struck("black_frame")
    assert not client.display.grab().any()
    client.clock.sleep(0.6)
    assert client.display.grab().any()


def test_after_a_lag_missed_ticks_run_before_a_key_release_arrives() -> None:
    client = VirtualClient(seed=3)
    client.clock.sleep(0.1)
    client.keyboard.press("w")
    client.clock.sleep(0.1)
    at = client.realm.player.feet[2]
    client.stall(0.5)
    client.keyboard.release("w")
    client.clock.sleep(0.45)
    assert client.realm.player.feet[2] == at
    client.clock.sleep(2.0)
    ways = [displacement(ticks, "walk") for ticks in range(10, 14)]
    assert any(client.realm.player.feet[2] - 0.5 == pytest.approx(way, abs=1e-6) for way in ways)


def test_only_ten_ticks_are_caught_up_with_after_a_long_lag() -> None:
    client = VirtualClient(seed=3)
    client.keyboard.press("w")
    client.clock.sleep(0.1)
    before = client.game.ticks
    client.stall(3.0)
    client.clock.sleep(3.0)
    assert client.game.ticks == before + 10


def test_a_dropped_key_press_never_arrives() -> None:
    client = struck("dropped_key")
    tap(client, "5")
    assert client.realm.player.slot == 0
    tap(client, "5")
    assert client.realm.player.slot == 4


def test_a_dropped_release_leaves_the_key_down_only_in_the_game() -> None:
    client = VirtualClient()
    client.keyboard.press("w")
    client.mishaps.plan("dropped_key")
    client.clock.sleep(0.1)
    client.keyboard.release("w")
    client.clock.sleep(1.0)
    assert client.window.down == set()
    assert client.game.keys.is_held("forward")
    tap(client, "w")
    assert not client.game.keys.is_held("forward")


def test_a_late_key_delays_the_keys_after_it() -> None:
    client = struck("late_key")
    client.keyboard.type("57")
    client.clock.sleep(0.04)
    assert client.realm.player.slot == 0
    client.clock.sleep(0.4)
    assert client.realm.player.slot == 6


def test_a_mishap_switches_the_debug_screen_off() -> None:
    client = struck("f3_off")
    client.clock.sleep(0.2)
    assert read(client).problem is not None
    tap(client, "f3")
    assert read(client).problem is None


def test_a_moved_window_shifts_the_mouse_position_and_a_resized_one_changes_its_pictures() -> None:
    moved = VirtualClient()
    tap(moved, "esc")
    moved.pointer.move(100, 100)
    moved.shift_window(30, -20)
    assert moved.pointer.position() == (70, 120)
    resized = struck("resized_window")
    assert resized.display.size() != (854, 480)
    assert resized.display.grab().shape[:2] == resized.display.size()[::-1]


def test_a_knocked_away_player_lands_somewhere_else() -> None:
    client = struck("knocked_away")
    client.clock.sleep(2.0)
    x, y, z = client.realm.player.feet
    assert y == 64.0
    assert max(abs(x - 0.5), abs(z - 0.5)) > 0.5


@pytest.mark.parametrize(("kind", "most"), [("refused_placing", 0), ("ghost_block", 1)])
def test_a_placing_mishap_leaves_no_block(kind: Kind, most: int) -> None:
    client = struck(kind)
    client.realm.player.hotbar[0] = Stack("stone", 64)
    client.pointer.press("right")
    client.clock.sleep(0.08)
    assert len(client.built) <= most
    client.pointer.release("right")
    client.clock.sleep(0.3)
    assert client.built == {}


@pytest.mark.parametrize("kind", KINDS)
def test_no_mishap_leads_away_from_the_title_screen(kind: Kind) -> None:
    client = VirtualClient()
    client.game.open("title")
    client.mishaps.plan(kind)
    client.clock.sleep(3.0)
    assert client.game.screen == "title"


def test_mishaps_come_at_their_rate() -> None:
    client = VirtualClient(seed=5)
    planned = sum(client.mishaps.maybe(0.1, 0.2, ("lag",)) for _ in range(1000))
    assert 70 < planned < 130
    client = VirtualClient(seed=5)
    client.mishaps.every(2.0, ("black_frame",))
    client.clock.sleep(100.0)
    assert 150 < len(client.mishaps.happened) < 250


class Target:
    """A client that only notes what happens to it."""

    def __init__(self) -> None:
        self.clock = VirtualClock(0.0)
        self.game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
        self.window = VirtualWindow(self.clock, Frames(math.inf), np.random.default_rng(0), SIZES[0], (0.0, 0.0))
        self.noted: list[tuple[str, float]] = []
        self.fronts: list[tuple[bool, float]] = []
        self.sizes: list[tuple[int, int]] = []
        self.shifts: list[tuple[int, int]] = []

    def set_front(self, *, is_in_front: bool) -> None:
        self.fronts.append((is_in_front, self.clock.now()))

    def stall(self, seconds: float) -> None:
        self.noted.append(("stall", seconds))

    def freeze(self, seconds: float) -> None:
        self.noted.append(("freeze", seconds))

    def blacken(self, seconds: float) -> None:
        self.noted.append(("blacken", seconds))

    def resize(self, size: tuple[int, int]) -> None:
        self.sizes.append(size)

    def shift_window(self, right: int, down: int) -> None:
        self.shifts.append((right, down))


def target_of(kind: Kind, count: int = 200) -> Target:
    """Return a client to which one kind of mishap happened ``count`` times."""
    target = Target()
    mishaps = Mishaps(target, np.random.default_rng(1))
    for _ in range(count):
        mishaps.plan(kind)
    target.clock.sleep(0.0)
    assert mishaps.happened == [Mishap(kind, 0.0)] * count
    return target


@pytest.mark.parametrize(
    ("kind", "what", "least", "most"),
    [("frozen_frame", "freeze", 0.1, 1.0), ("black_frame", "blacken", 0.05, 0.5), ("lag", "stall", 0.1, 1.0)],
)
def test_pictures_and_ticks_stop_for_a_time_within_bounds(kind: Kind, what: str, least: float, most: float) -> None:
    noted = target_of(kind).noted
    assert {name for name, _ in noted} == {what}
    seconds = sorted(duration for _, duration in noted)
    assert least <= seconds[0] < least + 0.1
    assert most - 0.1 < seconds[-1] <= most


def test_the_focus_comes_back_within_two_seconds() -> None:
    target = target_of("lost_focus", 1)
    assert target.fronts == [(False, 0.0)]
    target.clock.sleep(2.0)
    (is_in_front, seconds) = target.fronts[1]
    assert is_in_front
    assert 0.2 <= seconds <= 2.0


def test_a_resized_window_gets_any_of_the_other_sizes() -> None:
    assert set(target_of("resized_window").sizes) == set(SIZES[1:])


def test_a_window_is_moved_by_up_to_200_pixels_either_way() -> None:
    shifts = np.array(target_of("moved_window").shifts)
    assert (shifts.min(0) < -150).all()
    assert (shifts.max(0) > 150).all()
    assert np.abs(shifts).max() <= 200


def test_a_knock_pushes_the_player_with_a_fixed_strength() -> None:
    velocity = target_of("knocked_away", 1).game.realm.player.velocity
    assert np.hypot(velocity[0], velocity[2]) == pytest.approx(0.4)
    assert velocity[1] == pytest.approx(0.36 - 0.0784)


def test_keys_are_dropped_one_by_one() -> None:
    assert target_of("dropped_key", 3).window.to_drop == 3


def test_a_probability_of_one_always_plans_a_mishap_within_the_time() -> None:
    target = Target()
    mishaps = Mishaps(target, np.random.default_rng(0))
    planned = [mishaps.maybe(1.0, 0.5, ("lag", "f3_off")) for _ in range(50)]
    assert all(planned)
    assert mishaps.happened == []
    target.clock.sleep(0.5)
    assert len(mishaps.happened) == 50
    assert {mishap.kind for mishap in mishaps.happened} == {"lag", "f3_off"}
    assert max(mishap.at for mishap in mishaps.happened) > 0.4


def test_a_probability_of_zero_never_plans_a_mishap() -> None:
    target = Target()
    mishaps = Mishaps(target, np.random.default_rng(0))
    assert not any(mishaps.maybe(0.0, 0.5) for _ in range(50))
    target.clock.sleep(1.0)
    assert mishaps.happened == []


def test_ghost_blocks_and_notices_are_never_drawn_at_random() -> None:
    assert set(KINDS) - set(DRAWN) == {"ghost_block", "notices"}


def test_the_first_random_mishap_does_not_happen_at_once() -> None:
    target = Target()
    mishaps = Mishaps(target, np.random.default_rng(0))
    mishaps.every(0.01, ("lag",))
    target.clock.sleep(0.0)
    assert mishaps.happened == []
    target.clock.sleep(2000.0)
    assert 5 <= len(mishaps.happened) <= 40


def test_notices_make_the_debug_screen_unreadable_for_five_seconds() -> None:
    client = VirtualClient(pitch=65.0)
    client.clock.sleep(0.2)
    before = read(client)
    assert before.target is not None
    client.mishaps.plan("notices")
    client.clock.sleep(0.3)
    assert read(client).problem is not None
    client.clock.sleep(5.0)
    assert read(client) == before
