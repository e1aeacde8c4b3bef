"""Random actions against a live game: which are drawn, and how they are compared with the client's world."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, NotConfirmedError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Profile
from scripts.benches.live import connection_to, live_game, play_on
from scripts.benches.played import (
    GIVES_UP,
    CheckedGame,
    ClientTruth,
    PlayCounts,
    WorldTruth,
    drawn_action,
    figures_of,
    is_over,
    play_in,
)
from sim.client.client import VirtualClient
from tests.sim.client.playing import arena_of
from tests.sim.client.playing import play as playing

LINE = load_scenario("line")
SCENARIO = dataclasses.replace(load_scenario("diamond"), step_limit=5)


def played(truth: Callable[[VirtualClient, Arena], WorldTruth], actions: int) -> PlayCounts:
    client = VirtualClient(seed=1)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    with live_game(client, SCENARIO, arena) as game:
        return play_in(game, truth(client, arena), SCENARIO, range(actions), np.random.default_rng(0))


class Mistaken(ClientTruth):
    """Says of every third look that the player is elsewhere, and of every fourth that something else is built."""

    looks = 0

    def cell(self) -> Cell:
        self.looks += 1
        return (-1, -1) if self.looks % 3 == 0 else super().cell()

    def is_built(self, placed: set[Cell]) -> bool:
        return self.looks % 4 != 0 and super().is_built(placed)


def test_play_that_agrees_with_the_world_has_nothing_wrong() -> None:
    counts = played(ClientTruth, 12)
    assert counts.is_right
    assert (counts.actions, counts.failed_actions) == (12, 0)
    assert len(counts.moves_s) + len(counts.placings_s) == 12
    assert counts.placings_s
    assert counts.moves_s


def test_each_difference_from_the_world_is_counted() -> None:
    counts = played(Mistaken, 12)
    assert (counts.wrong_cells, counts.wrong_blocks) == (5, 3)


class Pausing(ClientTruth):
    """Tells the truth, but pauses the game at the third look."""

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        super().__init__(client, arena)
        self.client, self.looks = client, 0

    def is_built(self, placed: set[Cell]) -> bool:
        self.looks += 1
        if self.looks == 3:
            self.client.game.open("pause")
        return super().is_built(placed)


def test_an_action_that_fails_is_counted_and_begins_a_new_episode() -> None:
    counts = played(Pausing, 20)
    assert counts.failed_actions == 1
    assert len(counts.moves_s) + len(counts.placings_s) == 19
    assert counts.is_right


class Deceived:
    """Says that the agent stayed where it was, whatever it did; it fails at the third action."""

    resumable, log = None, None

    def __init__(self, game: LiveGame) -> None:
        self._game, self._acts_left = game, 3

    def reset(self, material: int) -> Cell:
        return self._game.reset(material)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        self._acts_left -= 1
        if not self._acts_left:
            raise LiveError("gone")
        self._game.act(action, material, following)
        return Outcome(LINE.start, None)


def test_answers_against_the_world_or_the_rules_are_counted_and_a_failed_episode_is_dropped() -> None:
    client = VirtualClient(seed=1)
    with playing(client, LINE) as live:
        game = CheckedGame(Deceived(live), ClientTruth(client, arena_of(client)), LINE, client.clock.now)
        assert game.reset(0) == LINE.start
        assert (game.counts.wrong_cells, game.counts.wrong_blocks, game.counts.unnoticed) == (0, 0, 0)
        game.act(Action.BD)
        assert (game.counts.wrong_cells, game.counts.wrong_blocks, game.counts.unnoticed) == (1, 1, 1)
        assert [len(episode) for episode in game.episodes] == [1]
        game.act(Action.BD)
        with pytest.raises(LiveError):
            game.act(Action.BD)
    assert game.episodes == []


@pytest.mark.parametrize("wrong", ["wrong_cells", "wrong_blocks", "unnoticed", "gave_up", "left_down", "strays"])
def test_play_with_a_single_wrong_count_is_not_right(wrong: str) -> None:
    assert PlayCounts(actions=5, corrections=3, failed_actions=2).is_right
    counts = PlayCounts()
    setattr(counts, wrong, 1)
    assert not counts.is_right


def test_world_counts_as_built_only_with_exactly_these_cells_and_the_earlier_blocks() -> None:
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


def test_episode_is_over_without_blocks_or_steps_left_or_with_the_agent_walled_in() -> None:
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
        play_on(client, game, arena, line, range(1), np.random.default_rng(0))
    assert game.tries == GIVES_UP


def test_figures_give_the_medians_of_moves_and_placings_separately_and_together() -> None:
    counts = PlayCounts(actions=4, moves_s=[0.1, 0.3], placings_s=[0.5, 0.7])
    summary = figures_of(counts)
    assert summary["actions"] == 4
    assert 0.3 <= summary["median_action_s"] <= 0.5
    assert 0.1 <= summary["moves"]["median_s"] <= 0.3
    assert 0.5 <= summary["placings"]["median_s"] <= 0.7
