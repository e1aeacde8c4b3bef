"""The benchmark of the live path: what its counts hold against a client's world, and which actions it draws."""

import numpy as np
import pytest

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, NotConfirmedError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.timing import FRAME_S
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile
from scripts.bench_live import (
    GIVES_UP,
    GROUND_PITCH,
    ClientTruth,
    PlayCounts,
    calibrated_walk,
    connection_to,
    drawn_action,
    figures,
    is_over,
    main,
    play,
    play_in,
)
from sim.client.client import VirtualClient


def test_nothing_is_wrong_in_a_short_play_without_mishaps() -> None:
    counts = play(12, 0.0, 3, load_scenario("diamond"))
    assert counts.is_right
    assert (counts.actions, counts.failed_actions, counts.mishaps) == (12, 0, 0)
    assert len(counts.moves_s) + len(counts.placings_s) == 12
    assert counts.resets >= 1
    assert min([*counts.moves_s, *counts.placings_s]) > 0
    assert sum([*counts.moves_s, *counts.placings_s]) < counts.played_s < 60


@pytest.mark.slow
def test_a_clients_older_pictures_are_found_by_calibration_and_played_with_as_well() -> None:
    found = calibrated_walk(VirtualClient(pitch=GROUND_PITCH, capture_latency_s=(0.075, 0.075)))
    assert found.input_latency_s + found.capture_latency_s == pytest.approx(0.075 + 0.0125 + FRAME_S / 2, abs=0.012)
    usual, slow = (play(40, 0.0, 1, load_scenario("diamond"), latency_ms) for latency_ms in (None, (60.0, 90.0)))
    assert usual.is_right
    assert slow.is_right
    assert slow.corrections <= 2
    assert sum([*usual.moves_s, *usual.placings_s]) + 1.0 < sum([*slow.moves_s, *slow.placings_s]) < 40 * 0.45


@pytest.mark.parametrize("latency_ms", [("90", "60"), ("-1", "5"), ("10", "900")])
def test_latencies_that_no_profile_holds_are_refused_in_a_line(
    latency_ms: tuple[str, str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["bench_live.py", "--latency-ms", *latency_ms])
    with pytest.raises(SystemExit, match="2"):
        main()
    assert "--latency-ms must be two times from 0 to 350, the shorter one first" in capsys.readouterr().err


@pytest.mark.parametrize("wrong", ["wrong_cells", "wrong_blocks", "unnoticed", "gave_up", "left_down", "strays"])
def test_each_wrong_count_alone_is_wrong(wrong: str) -> None:
    assert PlayCounts(actions=5, corrections=3, failed_actions=2).is_right
    counts = PlayCounts()
    setattr(counts, wrong, 1)
    assert not counts.is_right


def test_the_clients_world_is_as_built_only_with_these_cells_and_what_was_there() -> None:
    client = VirtualClient()
    client.realm.world.put((50, 64, 50), "dirt")
    arena = Arena.around((7, 64, 0), "south")
    truth = ClientTruth(client, arena)
    assert truth.cell() == (7, 0)
    assert truth.is_built(set())
    client.realm.world.put(arena.block_of((3, 4)), "stone")
    assert truth.is_built({(3, 4)})
    assert not truth.is_built(set())
    assert not truth.is_built({(3, 4), (3, 5)})
    client.realm.world.put((50, 64, 50), "air")
    assert not truth.is_built({(3, 4)})


def test_only_actions_that_do_something_are_drawn() -> None:
    rng = np.random.default_rng(0)
    corner, placed = (0, 0), {(1, 0)}
    drawn = {drawn_action(rng, corner, placed, 15) for _ in range(200)}
    for action in Action:
        target = rules.moved(corner, action, placed, 15)
        does_something = target != corner or rules.landing(target, action, placed, 15) is not None
        assert (action in drawn) == does_something
    assert 0 < len(drawn) < len(Action)


def test_an_episode_is_over_without_blocks_or_steps_and_where_the_agent_has_walled_itself_in() -> None:
    line = load_scenario("line")
    assert is_over((0, 0), {(1, 0), (0, 1)}, 1, line)
    assert not is_over((0, 0), {(1, 0)}, 1, line)
    assert is_over((0, 0), {(1, 0)}, line.step_limit, line)
    assert is_over((0, 0), {(5, each) for each in range(line.blocks)}, 1, line)


class LostGame(LiveGame):
    """A game that can't be reset."""

    tries = 0

    def reset(self, material: int) -> Cell:
        self.tries += 1
        raise NotConfirmedError(f"material {material} was not seen")


def test_a_game_that_can_not_be_reset_is_given_up() -> None:
    client, line = VirtualClient(seed=0), load_scenario("line")
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    game = LostGame(line, Profile(arena=arena), connection_to(client))
    with pytest.raises(LiveError, match=f"{GIVES_UP} resets in a row failed"):
        play_in(client, game, arena, line, range(1), 0.0, 0)
    assert game.tries == GIVES_UP


def test_the_figures_are_of_moves_and_placings_apart_and_together() -> None:
    counts = PlayCounts(actions=4, moves_s=[0.1, 0.3], placings_s=[0.5, 0.7])
    summary = figures(counts)
    assert summary["actions"] == 4
    assert 0.3 <= summary["median_action_s"] <= 0.5
    assert 0.1 <= summary["moves"]["median_s"] <= 0.3
    assert 0.5 <= summary["placings"]["median_s"] <= 0.7
