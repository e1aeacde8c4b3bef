"""The loop of the stand-in's benchmark, played on a virtual client: what it counts as wrong."""

import dataclasses

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.profile.arena import Arena
from scripts.bench_live import ClientTruth, live_game
from scripts.bench_standin import play
from sim.client.client import VirtualClient

SCENARIO = dataclasses.replace(load_scenario("diamond"), step_limit=5)


class Mistaken(ClientTruth):
    """Says of every third look that the player is elsewhere, and of every fourth that something else is built."""

    looks = 0

    def cell(self) -> Cell:
        self.looks += 1
        return (-1, -1) if self.looks % 3 == 0 else super().cell()

    def is_built(self, placed: set[Cell]) -> bool:
        return self.looks % 4 != 0 and super().is_built(placed)


def test_a_play_that_goes_as_it_should_has_nothing_wrong() -> None:
    client = VirtualClient(seed=1)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    with live_game(client, SCENARIO, arena) as game:
        counts = play(game, SCENARIO, ClientTruth(client, arena), 12, 0)
    assert counts.is_right
    assert (counts.actions, counts.failed_actions) == (12, 0)
    assert len(counts.moves_s) + len(counts.placings_s) == 12
    assert counts.placings_s
    assert counts.moves_s


def test_each_difference_from_the_world_is_counted() -> None:
    client = VirtualClient(seed=1)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    with live_game(client, SCENARIO, arena) as game:
        counts = play(game, SCENARIO, Mistaken(client, arena), 12, 0)
    assert (counts.wrong_cells, counts.wrong_blocks) == (4, 3)


class Pausing(ClientTruth):
    """True, but when it is asked for the third time, the game is paused."""

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        super().__init__(client, arena)
        self.client, self.looks = client, 0

    def is_built(self, placed: set[Cell]) -> bool:
        self.looks += 1
        if self.looks == 3:
            self.client.game.open("pause")
        return super().is_built(placed)


def test_an_action_that_fails_is_counted_and_begins_a_new_episode() -> None:
    client = VirtualClient(seed=1)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    with live_game(client, SCENARIO, arena) as game:
        counts = play(game, SCENARIO, Pausing(client, arena), 20, 0)
    assert counts.failed_actions == 1
    assert len(counts.moves_s) + len(counts.placings_s) == 19
    assert counts.is_right
