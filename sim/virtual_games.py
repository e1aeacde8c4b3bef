"""Games on the virtual client, for training on it: the live path, unchanged, without a window and in no real time."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

import numpy as np

from mc_nested.arena.scenario import Scenario
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.journal import Journal
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import FLOOR, Arena, border_block, border_of, floor_of, size_for
from mc_nested.live.profile.tables import BodyTable, GameVersion, Profile
from mc_nested.live.vision.game_screen import WindowScreen
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_font
from sim.client.drawing.painter import SEEN
from sim.client.game.world import VirtualWorld

GUI_SCALE = 1
"""The smallest GUI scale: its texts hide the least of the world."""

PITCH = 53.0
"""Degrees down at which the agents look. It is among the views that place right, and shows most of the arena."""

_ORIGIN_X, _ORIGIN_Z = -20, 31


class VirtualPlay:
    """Measures the game time of playing on virtual clients, for a training's summary."""

    def __init__(self, games: Sequence[LiveGame]) -> None:
        self._games = games
        self._clocks = [game.connection.devices.clock for game in games]
        self._began = [clock.now() for clock in self._clocks]

    @property
    def game_s(self) -> list[float]:
        """Seconds of game time that each game has been played."""
        return [clock.now() - began for clock, began in zip(self._clocks, self._began, strict=True)]

    def summary(self) -> dict[str, Any]:
        """Return the game time of each game in seconds, and what each game's own log says."""
        return {
            "game_s": [round(seconds, 3) for seconds in self.game_s],
            "games": [game.log.summary() for game in self._games],
        }


@contextmanager
def open_virtual_games(
    scenarios: Sequence[Scenario], seed: int = 0, journal: Journal | None = None
) -> Iterator[list[LiveGame]]:
    """Open a game for each scenario, on a virtual client of its own; each is closed after the block.

    Each has an arena as ``calibrate arena`` builds it: an obsidian floor, a border around. Where the scenario is
    smaller than that arena, the floor beside its cells is of the border's block.

    Args:
        scenarios: what is built, in each game.
        seed: of the clients' random numbers: latencies, and when their frames are drawn.
        journal: is told what the games wait for, read, plan and do.
    """
    with ExitStack() as stack:
        yield [
            stack.enter_context(_game(scenario, int(np.random.SeedSequence((seed, run)).generate_state(1)[0]), journal))
            for run, scenario in enumerate(scenarios)
        ]


def _game(scenario: Scenario, seed: int, journal: Journal | None) -> LiveGame:
    client = VirtualClient(seed=seed, world=SEEN, scale=GUI_SCALE)
    arena = built_arena(client.realm.world, scenario)
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena, body=BodyTable(pitch=PITCH))
    controller = InputController(client.devices, profile.input)
    screen = WindowScreen(client.display, drawn_font(), version=client.settings.version)
    return LiveGame(scenario, profile, GameConnection(client.devices, controller, screen, journal=journal))


def built_arena(world: VirtualWorld, scenario: Scenario) -> Arena:
    """Build the arena for a scenario into a world, and return it."""
    arena = Arena.around((_ORIGIN_X, world.floor, _ORIGIN_Z), "south", size=size_for(scenario))
    border = border_block([material.block for material in scenario.materials])
    world.fill(*floor_of(arena), border)
    low, high = arena.block_of((0, 0)), arena.block_of((scenario.size - 1, scenario.size - 1))
    world.fill((low[0], low[1] - 1, low[2]), (high[0], high[1] - 1, high[2]), FLOOR)
    for side in border_of(arena):
        world.fill(*side, border)
    return arena
