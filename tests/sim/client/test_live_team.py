"""The live path with two bodies in one virtual world: each its own client, window, devices and profile."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import numpy as np
import pytest

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import NO_ACTION
from mc_nested.errors import LiveError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.builders import Builders
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.preset import load_preset
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.tables import GameVersion, Profile
from scripts.examples.live_team import LiveTeam, scenario_of
from sim.client.client import VirtualClient
from sim.team_grid import TeamGrid
from tests.arena.cooperative.team_game_contract import Ticks, Truth, check_team_game
from tests.sim.client.playing import arena_of, connection_to

LINE = load_scenario("line")
STONE = 1
F, B, L, R, FD, LD, RD, BD = Action


@contextmanager
def played(team: Team) -> Iterator[tuple[LiveTeam, list[VirtualClient]]]:
    """Open a team on virtual clients that share a world."""
    first = VirtualClient(seed=0)
    clients = [first, *(VirtualClient(seed=number, joins=first) for number in range(1, team.builders))]
    with ExitStack() as games:
        yield LiveTeam(team, [games.enter_context(game_of(team, each, c)) for each, c in enumerate(clients)]), clients


def game_of(team: Team, builder: int, client: VirtualClient) -> LiveGame:
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client))
    return LiveGame(scenario_of(team, builder), profile, connection_to(client, is_server_allowed=True))


def truth_of(clients: list[VirtualClient]) -> Truth:
    arena = arena_of(clients[0])

    def truth() -> tuple[tuple[Cell, ...], set[Cell]]:
        return tuple(client.cell(arena) for client in clients), clients[0].placed(arena)

    return truth


MET: Ticks = [(R, L), (RD, LD), (B, B), (BD, BD), (None, LD), (R, F), (F, FD), (L, None)]
"""From neighbouring cells: into each other, onto each other, past each other's blocks."""


def test_a_live_team_of_two_keeps_the_team_contract() -> None:
    team = Team(LINE, ((7, 12), (8, 12)))
    with played(team) as (game, clients):
        check_team_game(game, team, MET, truth_of(clients))
        assert [client.window.strays for client in clients] == [[], []]
    assert [client.window.down for client in clients] == [set(), set()]


TOGETHER: Ticks = [(B, None), (B, None), *[(BD, None)] * 6, (R, RD), *[(None, BD)] * 4]
"""Builder 0 builds the upper six blocks and steps aside; builder 1 comes in where it stood, and does the rest."""


def test_two_bodies_build_the_line_together() -> None:
    team = Team(LINE, ((7, 14), (6, 5)))
    with played(team) as (game, clients):
        env = TeamVectorEnv([game], team)
        env.reset(options={"material": np.array([STONE, STONE])})
        steps = [env.step(np.array([NO_ACTION if action is None else action for action in tick])) for tick in TOGETHER]
        cells, placed = truth_of(clients)()
    assert placed == env.placed(0) == LINE.design
    assert cells == (env.cell(0), env.cell(1)) == ((8, 6), (7, 1))
    assert np.sum([rewards for _, rewards, *_ in steps], axis=0).tolist() == [6.0, 5.0]
    *_, terminated, _, info = steps[-1]
    assert (terminated.tolist(), info["score"].tolist()) == ([True] * 2, [LINE.optimum] * 2)


def test_a_policy_plays_in_a_live_team_as_in_the_simulator() -> None:
    team = team_of(LINE, 2)
    builders = Builders(team.starts, "own")
    agent = Agent(AGENT_SPECS["nested"], [LINE], load_preset("paper"), seed=5, team=builders)
    simulated = play_greedily(TeamVectorEnv([TeamGrid(team)], team), [LINE], agent)
    with played(team) as (game, _):
        assert play_greedily(TeamVectorEnv([game], team), [LINE], agent) == simulated


def test_repeated_ticks_of_a_team_take_the_same_game_time() -> None:
    def clock_after() -> float:
        team = Team(LINE, ((7, 12), (8, 12)))
        with played(team) as (game, clients):
            game.reset(STONE)
            for tick in MET:
                game.act(tick)
            return clients[0].clock.now()

    assert clock_after() == clock_after()


def test_a_failed_tick_leaves_no_key_down_and_requires_a_reset() -> None:
    team = Team(LINE, ((7, 12), (3, 3)))
    with played(team) as (game, clients):
        game.reset(STONE)
        clients[1].set_front(is_in_front=False)
        with pytest.raises(LiveError):
            game.act((B, B))
        assert [client.window.down for client in clients] == [set(), set()]
        clients[1].set_front(is_in_front=True)
        with pytest.raises(LiveError, match="the arena must be reset first"):
            game.act((B, B))
        assert game.reset(STONE) == team.starts


def test_a_shared_world_says_so_in_each_title_and_is_refused_by_default() -> None:
    first = VirtualClient()
    second = VirtualClient(joins=first)
    assert {first.display.title(), second.display.title()} == {"Minecraft 1.20.1 - Multiplayer (LAN)"}
    with pytest.raises(Exception, match="so others may be playing there"):
        connection_to(first).check_single_player()


def test_a_live_team_needs_a_running_game_for_each_builder() -> None:
    with pytest.raises(LiveError, match=r"^2 builders and 0 running games: open one for each$"):
        LiveTeam(Team(LINE, ((7, 12), (3, 3))), [])
