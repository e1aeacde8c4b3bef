"""The walk is measured on the virtual client: it finds the client's physics, and no mishap spoils the profile."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from calibration.context import StepResult
from calibration.walk.gait_fit import rms
from calibration.walk.measure import WITHOUT_TICKS, calibrate_walk, walk
from mc_nested.errors import DesktopError, McNestedError, NotConfirmedError, NotInFrontError, UserError
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import KeysTable, Profile, WalkTable
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from sim.client.mishaps import Kind
from tests.calibration.contexts import context_on, kept_profile, profile_of

LONGEST_S = 90.0

LATER = [pytest.param(after_s, marks=pytest.mark.slow) for after_s in (15.0, 40.0)]
"""Seconds after which somebody interferes: while the player sneaks out, and while it walks."""


def measured(client: VirtualClient, folder: Path, profile: Profile | None = None) -> StepResult:
    """Measure in less than 90 seconds of game time, with no key left down and none to another window."""
    profile = profile or profile_of(client, folder)
    began = client.clock.now()
    with context_on(client)(profile) as context:
        found = walk(context, profile)
    assert client.clock.now() - began < LONGEST_S
    assert client.window.down == set()
    assert client.window.strays == []
    return found


def off_held_out(client: VirtualClient, found: StepResult, patch: pytest.MonkeyPatch) -> float:
    """Return how far off new holds end that the profile predicts by the ticks truly felt: RMS, in blocks."""
    felt: list[bool] = []
    tick = client.game.tick

    def counted() -> None:
        felt.append(client.game.keys.is_held("forward") or client.game.keys.is_held("back"))
        tick()

    patch.setattr(client.game, "tick", counted)
    rng = np.random.default_rng(1)
    offs = []
    for index in range(16):
        felt.clear()
        x, _, z = client.realm.player.feet
        key = (found.profile.keys.forward, found.profile.keys.back)[index % 2]
        client.keyboard.press(key)
        client.clock.sleep((1 + index % 8 + rng.uniform(0, 0.9)) * TICK_S)
        client.keyboard.release(key)
        client.clock.sleep(1.5)
        east, _, south = client.realm.player.feet
        covered = ((east - x) ** 2 + (south - z) ** 2) ** 0.5
        offs.append(covered - found.profile.walk.covered[sum(felt) - 1])
    return rms(offs)


def test_walking_is_measured_where_the_player_stands_and_ends_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(pitch=65.0)
    found = measured(client, tmp_path)
    assert found.profile.keys == KeysTable()
    assert found.profile.walk.inertia == pytest.approx(0.546, abs=0.002)
    assert found.profile.walk.sneaking == pytest.approx(0.3, abs=0.002)
    assert found.samples > 40
    assert max(abs(now - then) for now, then in zip(client.realm.player.feet, (0.5, 64, 0.5), strict=True)) < 0.2
    assert found.pictures[0].frame.shape == (420, 1000, 3)
    assert not [line for line in found.lines if "Warning" in line]
    assert "Timed between two ticks, 8 of 8" in " ".join(found.lines)
    assert off_held_out(client, found, monkeypatch) < 0.02


@pytest.mark.slow
def test_walk_at_ten_frames_a_second_is_measured_with_a_round_trip_of_at_least_40_ms(tmp_path: Path) -> None:
    found = measured(VirtualClient(seed=1, pitch=65.0, fps=10.0), tmp_path)
    walk_table = found.profile.walk
    assert walk_table.covered == pytest.approx(WalkTable().covered, abs=0.002)
    assert walk_table.input_latency_s + walk_table.capture_latency_s >= 0.04


class Glider:
    """Lets a client's player glide without ticks: at a speed while a key is down, a step each 120th of a second."""

    def __init__(self, client: VirtualClient, speed: float) -> None:
        self._client, self._speed = client, speed
        self._glide()

    def _glide(self) -> None:
        client = self._client
        client.clock.call_at(client.clock.now() + 1 / 120, self._glide)
        keys, player = client.game.keys, client.realm.player
        step = self._speed / 120 * (0.3 if keys.is_held("sneak") else 1.0)
        x, y, z = player.feet
        x += step * (keys.is_held("left") - keys.is_held("right"))
        z += step * (keys.is_held("forward") - keys.is_held("back"))
        if player.feet != (x, y, z):
            player.feet = (x, y, z)
            client.display.show(client.game.view())


def test_game_without_ticks_gets_a_linear_walk_and_a_warning(tmp_path: Path) -> None:
    client = VirtualClient(pitch=65.0, speed=0.0)
    Glider(client, 4.3)
    found = measured(client, tmp_path)
    assert WITHOUT_TICKS in found.lines
    walk_table = found.profile.walk
    for ticks in (3, 6, 12):
        assert walk_table.covered[ticks - 1] == pytest.approx(4.3 * ticks * TICK_S, abs=0.08)
    assert walk_table.sneaking == pytest.approx(0.3, abs=0.02)
    assert found.pictures[0].frame.shape == (420, 1000, 3)
    assert max(abs(now - then) for now, then in zip(client.realm.player.feet, (0.5, 64, 0.5), strict=True)) < 0.25


def test_a_walk_that_fails_brings_the_player_back(tmp_path: Path) -> None:
    client = VirtualClient(seed=2, pitch=20.0)
    arena = Arena.around((-20, 64, 31), "east")
    profile = profile_of(client, tmp_path).model_copy(update={"arena": arena, "keys": KeysTable(left="j")})
    with pytest.raises(UserError, match="the key j doesn't move the player left"):
        measured(client, tmp_path, profile)
    client.clock.sleep(0.5)
    assert client.realm.player.feet == (0.5, 64.0, 0.5)
    assert (client.realm.player.yaw, client.realm.player.pitch) == (0.0, 20.0)


@pytest.mark.parametrize("floor", [None, pytest.param("stone", marks=pytest.mark.slow)])
def test_hole_in_a_marked_arena_is_refilled_or_is_an_error_that_brings_the_player_back(
    floor: str | None, tmp_path: Path
) -> None:
    client = VirtualClient(seed=2, pitch=20.0)
    arena = Arena.around((-20, 64, 31), "east").model_copy(update={"floor": floor})
    (x, y, z), _ = arena.region
    middle = arena.block_of((7, 7))
    hole = (middle[0] + 1, y - 1, middle[2])
    assert x <= hole[0]
    assert z <= hole[2]
    client.realm.world.put(hole, "air")
    profile = profile_of(client, tmp_path).model_copy(update={"arena": arena})
    if floor is not None:
        assert "Warning" not in " ".join(measured(client, tmp_path, profile).lines)
        assert client.realm.world.block_at(hole) == floor
    else:
        with context_on(client)(profile) as context, pytest.raises(UserError, match="or the floor ends"):
            walk(context, profile)
        assert client.realm.player.feet == (0.5, 64.0, 0.5)


def test_a_hole_is_refilled_before_any_key_is_tried(tmp_path: Path) -> None:
    """The key that does nothing ends the measurement at its first step."""
    client = VirtualClient(seed=2, pitch=20.0)
    arena = Arena.around((-20, 64, 31), "east").model_copy(update={"floor": "stone"})
    x, y, z = arena.block_of((7, 7))
    client.realm.world.put((x + 1, y - 1, z), "air")
    profile = profile_of(client, tmp_path).model_copy(update={"arena": arena, "keys": KeysTable(left="j")})
    with pytest.raises(UserError, match="the key j doesn't move the player left"):
        measured(client, tmp_path, profile)
    assert client.realm.world.block_at((x + 1, y - 1, z)) == "stone"


@pytest.mark.parametrize(("size", "middle"), [(15, 7), pytest.param(20, 10, marks=pytest.mark.slow)])
def test_walk_in_a_marked_arena_stays_near_its_middle_and_returns_to_the_start(
    size: int, middle: int, tmp_path: Path
) -> None:
    client = VirtualClient(seed=2, pitch=20.0, swaps_sides=True)
    arena = Arena.around((-20, 64, 31), "east", size=size)
    visited = set()
    tick = client.game.tick

    def noted() -> None:
        tick()
        visited.add(client.cell(arena))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(client.game, "tick", noted)
        found = measured(client, tmp_path, profile_of(client, tmp_path).model_copy(update={"arena": arena}))
    inside = {cell for cell in visited if max(abs(cell[0] - middle), abs(cell[1] - middle)) < 8}
    assert {(middle + x, middle + y) for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))} <= inside
    assert all(abs(x - middle) <= 3 and abs(y - middle) <= 3 for x, y in inside)
    assert client.realm.player.feet == (0.5, 64.0, 0.5)
    assert (client.realm.player.yaw, client.realm.player.pitch) == (0.0, 20.0)
    assert (found.profile.keys.left, found.profile.keys.right) == ("d", "a")
    assert "d goes left, a goes right; the profile had left and right the other way round" in found.lines[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fps", "into_s", "out_s"),
    [
        (144.0, (0.001, 0.004), (0.002, 0.010)),
        (30.0, (0.020, 0.040), (0.010, 0.030)),
        (24.0, (0.03, 0.06), (0.02, 0.06)),
    ],
)
def test_other_frame_rates_and_latencies_give_the_same_walk_and_their_own_round_trip(
    fps: float, into_s: tuple[float, float], out_s: tuple[float, float], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(seed=3, pitch=65.0, fps=fps, input_latency_s=into_s, capture_latency_s=out_s)
    found = measured(client, tmp_path)
    trip = found.profile.walk.input_latency_s + found.profile.walk.capture_latency_s
    # Frames fall at the same time after each tick, or nearly: half a frame is what that can be off the mean.
    assert trip == pytest.approx(sum(into_s) / 2 + sum(out_s) / 2 + 0.5 / fps, abs=0.5 / fps + 0.006)
    assert off_held_out(client, found, monkeypatch) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize(("slipperiness", "speed", "steady"), [(0.6, 1.4, 6.044), (0.8, 0.8, 2.429), (0.6, 1.2, 5.181)])
def test_other_floors_and_speeds_are_measured_and_reported(
    slipperiness: float, speed: float, steady: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(seed=4, pitch=65.0, slipperiness=slipperiness, speed=speed)
    found = measured(client, tmp_path)
    said = next(line for line in found.lines if line.startswith("Walking "))
    assert float(said.split()[1]) == pytest.approx(steady, abs=0.005)
    assert any("An effect or another floor?" in line for line in found.lines)
    assert off_held_out(client, found, monkeypatch) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_occasional_lag_does_not_spoil_the_accuracy_of_the_walk(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(seed=seed, pitch=65.0)
    client.mishaps.every(0.12, ("lag", "frozen_frame", "late_key"))
    found = measured(client, tmp_path)
    assert client.mishaps.happened
    quiet = VirtualClient(seed=seed + 50, pitch=65.0)
    assert off_held_out(quiet, found, monkeypatch) < 0.02


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_latencies_of_a_quick_game_are_measured_although_it_stalls(seed: int, tmp_path: Path) -> None:
    client = VirtualClient(seed=seed, pitch=65.0, input_latency_s=(0.001, 0.004), capture_latency_s=(0.002, 0.006))
    rng = np.random.default_rng(seed)

    def stall() -> None:
        client.stall(float(rng.uniform(0.1, 0.2)))
        client.clock.call_at(client.clock.now() + float(rng.exponential(1.0)), stall)

    stall()
    walk_table = measured(client, tmp_path).profile.walk
    assert walk_table.input_latency_s + walk_table.capture_latency_s == pytest.approx(0.0105, abs=0.006)


@pytest.mark.slow
def test_constant_lag_is_reported(tmp_path: Path) -> None:
    client = VirtualClient(seed=2, pitch=65.0)
    client.mishaps.every(0.35, ("lag",))
    found = measured(client, tmp_path)
    assert any(line.startswith("Warning: the game lags") for line in found.lines)


def wall(client: VirtualClient) -> None:
    client.realm.world.put((1, 64, 0), "stone")


def pit(client: VirtualClient) -> None:
    for z in (-1, 0, 1):
        client.realm.world.fill((-2, 60, z), (-1, 63, z), "air")


@pytest.mark.parametrize(("spoil", "where"), [(wall, r"0\.[123] blocks left"), (pit, r"0\.[789] blocks right")])
def test_block_or_edge_in_the_way_is_an_error_that_says_where(
    spoil: Callable[[VirtualClient], None], where: str, tmp_path: Path
) -> None:
    client = VirtualClient(pitch=65.0)
    spoil(client)
    with pytest.raises(UserError, match=where):
        measured(client, tmp_path)
    assert client.realm.player.feet[1] == 64.0
    assert client.window.down == set()


def test_key_that_does_not_move_the_player_is_named_in_the_error(tmp_path: Path) -> None:
    client = VirtualClient(pitch=65.0)
    profile = profile_of(client, tmp_path).model_copy(update={"keys": KeysTable(left="j")})
    with pytest.raises(UserError, match="the key j doesn't move the player left"):
        measured(client, tmp_path, profile)


@pytest.mark.slow
def test_sneaking_key_without_an_effect_is_an_error(tmp_path: Path) -> None:
    client = VirtualClient(pitch=65.0)
    profile = profile_of(client, tmp_path).model_copy(update={"keys": KeysTable(sneak="k")})
    with pytest.raises(NotConfirmedError, match="sneaking is no slower than walking"):
        measured(client, tmp_path, profile)


def test_walk_in_a_shared_game_is_refused_and_the_player_does_not_move(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = VirtualClient(pitch=20.0)
    client.realm.world.put((-20, 64, 35), "stone")
    before = client.built
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (3rd-party Server)")
    arena = Arena.around((-20, 64, 31), "east")
    with pytest.raises(DesktopError, match=r"others may be playing there.*--server-allowed"):
        measured(client, tmp_path, profile_of(client, tmp_path).model_copy(update={"arena": arena}))
    assert client.built == before
    assert client.realm.player.feet == (0.5, 64.0, 0.5)


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    """Return a profile's file, which names no walk of its own."""
    return kept_profile(VirtualClient(), tmp_path)


@pytest.mark.slow
def test_measured_walk_is_written_into_the_profile_with_its_picture(kept: Path) -> None:
    found, picture = calibrate_walk(kept, context_on(VirtualClient(pitch=65.0)))
    assert load_profile(kept) == found.profile
    assert picture == kept.with_name("mine-walk.png")
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("after_s", [0.3, 3.0, *LATER])
@pytest.mark.parametrize(
    ("kind", "error"),
    [
        ("lost_focus", NotInFrontError),
        ("chat", McNestedError),
        ("death", McNestedError),
        ("knocked_away", NotConfirmedError),
        ("f3_off", McNestedError),
    ],
)
def test_interference_during_the_walk_is_a_one_line_error_and_leaves_the_profile_unchanged(
    kind: Kind, error: type[McNestedError], after_s: float, kept: Path
) -> None:
    before = kept.read_bytes()
    client = VirtualClient(pitch=65.0, options=GameOptions(pause_on_lost_focus=False))
    client.mishaps.plan(kind, after_s)
    with pytest.raises(error) as caught:
        calibrate_walk(kept, context_on(client))
    assert "\n" not in str(caught.value)
    assert kept.read_bytes() == before
    assert client.window.down == set()
    assert client.window.strays == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["moved_window", "resized_window", "black_frame"])
def test_moved_resized_or_briefly_black_window_does_not_disturb_the_measurement(kind: Kind, tmp_path: Path) -> None:
    client = VirtualClient(seed=6, pitch=65.0)
    for after_s in (3.0, 12.0, 25.0):
        client.mishaps.plan(kind, after_s)
    assert measured(client, tmp_path).samples > 35


class Cut:
    """Ends the calibration at a time of the client's clock, as Ctrl+C or a closed window does."""

    def __init__(self, client: VirtualClient, after_s: float, error: BaseException) -> None:
        self._is_in_front, self._clock, self._error = client.display.is_in_front, client.clock, error
        self._at = client.clock.now() + after_s

    def is_in_front(self) -> bool:
        if self._clock.now() >= self._at:
            self._at = float("inf")
            raise self._error
        return self._is_in_front()


@pytest.mark.parametrize("after_s", [0.1, 3.0, *LATER])
@pytest.mark.parametrize("error", [KeyboardInterrupt(), DesktopError("the game's window has closed: open it again")])
def test_ctrl_c_or_a_closed_window_at_any_time_leaves_keys_up_and_the_profile_as_it_was(
    error: BaseException, after_s: float, kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = kept.read_bytes()
    client = VirtualClient(pitch=65.0)
    monkeypatch.setattr(client.display, "is_in_front", Cut(client, after_s, error).is_in_front)
    with pytest.raises(type(error)):
        calibrate_walk(kept, context_on(client))
    assert kept.read_bytes() == before
    assert client.window.down == set()
    assert list(kept.parent.glob("*.part")) == []
