"""Walker: the record of a hold, its early end, and errors during it."""

import pytest

from calibration.walk.walker import RecordedHold, Sighting, Walker
from mc_nested.errors import NotConfirmedError, NotInFrontError
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import displacement
from mc_nested.live.model.reading import Reading
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, FakeScreen, connection_to
from tests.live.notes import Notes

PROFILE = Profile()


@pytest.fixture
def game() -> FakeGame:
    return FakeGame(PROFILE, xyz=(10.5, 64.0, -3.5), yaw=90.0, pitch=20.0)


def _walker(game: FakeGame) -> Walker:
    return Walker(connection_to(game), PROFILE)


def test_positions_are_relative_to_the_pose_at_the_beginning(game: FakeGame) -> None:
    walker = _walker(game)
    assert walker.stand() == (0.0, 0.0)
    # Yaw 90 looks west, which is -X; right of it is north, which is -Z.
    game.xyz = (9.5, 64.0, -5.5)
    game.clock.time += 0.1
    assert walker.position() == pytest.approx((2.0, 1.0))


@pytest.mark.parametrize(("keys", "axis", "sign"), [("w", 1, 1), ("s", 1, -1), ("d", 0, 1), ("a", 0, -1)])
def test_a_hold_is_recorded_step_by_step_until_standstill(game: FakeGame, keys: str, axis: int, sign: int) -> None:
    walker = _walker(game)
    recorded = walker.hold(0.2, keys)
    assert recorded.held_s == pytest.approx(0.2)
    assert recorded.offsets[-1][axis] == pytest.approx(sign * displacement(4), abs=0.001)
    assert abs(recorded.offsets[-1][1 - axis]) < 1e-9
    # Every step of four ticks and the coasting after them; the first is one push.
    assert len(recorded.offsets) == 4 + 6
    assert recorded.offsets[0][axis] == pytest.approx(sign * 0.098, abs=0.001)
    assert recorded.end == walker.stand()
    assert game.down == set()


def test_walker_notes_each_hold_in_ticks_in_the_journal(game: FakeGame) -> None:
    notes = Notes()
    connection = connection_to(game)
    connection.journal = notes
    walker = Walker(connection, PROFILE)
    walker.hold(0.2, "w")
    walker.hold(0.27, "s", sneak="left.shift")
    assert notes.of("plans") == [
        {"key": "w", "ticks": 4, "sneak": False},
        {"key": "s", "ticks": 5, "sneak": True},
    ]


def test_each_sighting_gives_the_times_of_the_looks_before_and_after_its_step(game: FakeGame) -> None:
    recorded = _walker(game).hold(0.2, "w")
    assert all(0 < sighting.at - sighting.since < 0.012 for sighting in recorded.sightings)
    gaps = [after.at - before.at for before, after in zip(recorded.sightings, recorded.sightings[1:], strict=False)]
    assert gaps == pytest.approx([0.05] * len(gaps), abs=0.009)


def test_the_keys_go_down_a_whole_number_of_ticks_after_the_phase(game: FakeGame) -> None:
    recorded = _walker(game).hold(0.1, "w", phase=0.013)
    assert (recorded.pressed - 0.013) % 0.05 == pytest.approx(0.0, abs=1e-9) or (
        recorded.pressed - 0.013
    ) % 0.05 == pytest.approx(0.05, abs=1e-9)


def test_a_hold_ends_early_at_its_largest_distance(game: FakeGame) -> None:
    recorded = _walker(game).hold(2.0, "w", max_distance=1.0)
    assert 0.2 < recorded.held_s < 0.4
    assert recorded.offsets[-1].forward < 1.0 + 3 * 0.216


def test_a_key_without_effect_is_watched_for_a_second(game: FakeGame) -> None:
    recorded = _walker(game).hold(0.1, "j")
    assert recorded.sightings == ()
    assert recorded.end == recorded.begin == (0.0, 0.0)
    assert game.clock.now() - recorded.released == pytest.approx(1.0, abs=0.02)


def test_stand_waits_five_ticks_only_if_the_player_has_left_the_last_holds_end(game: FakeGame) -> None:
    walker = _walker(game)
    walker.hold(0.1, "w")
    began = game.clock.now()
    walker.stand()
    assert game.clock.now() == began
    game.xyz = (game.xyz[0] - 0.5, *game.xyz[1:])
    game.clock.time += 0.1
    began = game.clock.now()
    assert walker.stand().forward == pytest.approx(displacement(2) + 0.5, abs=0.3)
    assert game.clock.now() - began == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize(
    ("reading", "complaint"),
    [
        (Reading((10.5, 64.5, -3.5), 90.0, 20.0), "the feet are at y = 64.5, not 64"),
        (Reading((10.5, 64.0, -3.5), 92.0, 20.0), "the view is 92 / 20, not 90 / 20"),
    ],
)
def test_a_player_who_rises_or_turns_during_a_hold_is_an_error_with_every_key_up(
    game: FakeGame, reading: Reading, complaint: str
) -> None:
    screen = FakeScreen(game, lambda: reading if game.clock.now() > 100.35 else None)
    walker = Walker(connection_to(game, screen), PROFILE)
    walker.stand()
    assert game.clock.now() < 100.35
    with pytest.raises(NotConfirmedError, match=complaint):
        walker.hold(0.5, "w")
    assert game.down == set()


def test_a_window_that_loses_the_focus_during_a_hold_ends_it_at_once(game: FakeGame) -> None:
    walker = _walker(game)
    walker.stand()
    game.front_until = game.clock.now() + 0.1
    with pytest.raises(NotInFrontError):
        walker.hold(1.0, "w")
    assert game.down == set()
    assert game.clock.now() < game.front_until + 0.02


def test_a_record_without_sightings_ends_where_it_began() -> None:
    begin = GroundVector(1.0, 2.0)
    assert RecordedHold(0.0, 0.1, begin, ()).end == begin
    seen = (Sighting(0.0, 0.1, GroundVector(1.5, 2.0)), Sighting(0.1, 0.2, GroundVector(1.5, 2.25)))
    recorded = RecordedHold(0.0, 0.1, begin, seen)
    assert recorded.end == (1.5, 2.25)
    assert recorded.offsets == ((0.5, 0.0), (0.5, 0.25))
