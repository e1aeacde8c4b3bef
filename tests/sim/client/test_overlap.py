"""Actions that overlap, on the virtual client: how fast, what is noticed and when, and that no key is left down."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build, build_with_materials
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, StoppedError
from mc_nested.live.live_game import LiveGame
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.profile.tables import Profile
from scripts.benches.live import live_game
from scripts.benches.played import CheckedGame, ClientTruth
from scripts.benches.played import play as random_play
from sim.client.client import VirtualClient
from sim.client.desktop.clock import Event
from tests.live.notes import Notes
from tests.sim.client.playing import arena_of, connection_to, play

LINE, DIAMOND, FLAG = load_scenario("line"), load_scenario("diamond"), load_scenario("flag")
WALKING_S = 0.2317
"""Seconds a cell of steady walking: 1 / 0.2158 ticks (FACTS: Walking)."""
LONGEST_WALKING_STEP = 0.217

Mishap = Callable[[VirtualClient, LiveGame], None]


def build_told(game: LiveGame, actions: list[Action]) -> None:
    """Do these actions, each told the next."""
    for action, following in pairwise([*actions, None]):
        assert action is not None
        game.act(action, None, None if following is None else (following, None))


def warm(client: VirtualClient, game: LiveGame) -> None:
    """Play until it is known when the ticks come, and reset the game."""
    game.reset(0)
    build_told(game, [Action.B, Action.L, Action.R, Action.L, Action.R, Action.L])
    game.reset(0)
    assert client.window.down == set()


def test_a_straight_run_takes_hardly_longer_than_walking() -> None:
    client = VirtualClient(seed=4)
    with play(client, LINE) as game:
        warm(client, game)
        build_told(game, build(LINE)[:3])
        corrected = game.log.effort.corrections
        game.reset(0)
        actions = build(LINE)
        build_told(game, actions)
        seconds = sum(game.log.seconds[-10:]) / 10
    assert seconds <= 1.06 * WALKING_S
    assert game.log.effort.corrections == corrected
    assert client.placed(arena_of(client)) == set(LINE.design)
    assert client.window.down == set()


def test_one_press_walks_a_straight_run(monkeypatch: pytest.MonkeyPatch) -> None:
    client = VirtualClient(seed=4)
    with play(client, LINE) as game:
        warm(client, game)
        presses, press = list[str](), client.window.press

        def noted(name: str, event: Event) -> None:
            presses.append(name)
            press(name, event)

        monkeypatch.setattr(client.window, "press", noted)
        build_told(game, build(LINE)[:-2])
    assert presses == ["s", *["right button"] * 9]


def test_an_agent_that_overlaps_never_sprints() -> None:
    client = VirtualClient(seed=5)
    with play(client, DIAMOND) as game:
        game.reset(0)
        for action, following in pairwise([Action.B, *[Action.F, Action.B] * 8, Action.L]):
            game.act(action, None, (following, None))
            steps = [abs(after[1][2] - before[1][2]) for before, after in pairwise(list(client.way)[-60:])]
            assert max(step for step in steps if step < 1) <= LONGEST_WALKING_STEP


def test_two_materials_land_where_they_were_announced() -> None:
    client = VirtualClient(seed=2)
    arena = arena_of(client)
    with play(client, FLAG) as game:
        warm(client, game)
        steps = build_with_materials(FLAG)
        for step, following in pairwise([*steps, None]):
            assert step is not None
            game.act(*step, following)
        assert game.log.effort.overlapped > len(steps) / 2
    of_cell = {cell: client.built[arena.block_of(cell)] for cell in client.placed(arena)}
    assert of_cell == {
        cell: name for part, name in zip(FLAG.parts, ("stone", "oak_planks"), strict=True) for cell in part.cells
    }


def test_another_action_than_the_announced_one_is_an_error() -> None:
    client = VirtualClient(seed=4)
    with play(client, LINE) as game:
        warm(client, game)
        game.act(Action.B, None, (Action.B, None))
        assert client.window.down == {"s"}
        with pytest.raises(ValueError, match="was announced as the action that follows"):
            game.act(Action.L)
        assert client.window.down == set()
        assert game.reset(0) == LINE.start


def test_without_overlap_every_key_is_up_between_two_actions() -> None:
    client = VirtualClient(seed=4)
    with live_game(client, LINE, arena_of(client), overlaps=False) as game:
        warm(client, game)
        for action, following in pairwise(build(LINE)):
            game.act(action, None, (following, None))
            assert client.window.down == set()
        assert game.log.effort.overlapped == 0


def test_a_caller_that_asks_for_nothing_more_leaves_no_key_down() -> None:
    """The watchdog lets go of the key in time: the agent stops in the announced cell, and goes on from there."""
    client = VirtualClient(seed=4)
    with play(client, LINE) as game:
        warm(client, game)
        game.act(Action.B, None, (Action.B, None))
        for _ in range(20):
            client.clock.sleep(TICK_S)
            game.connection.controller.release_overdue()
        assert client.window.down == set()
        assert client.cell(arena_of(client)) in ((7, 12), (7, 11))
        assert game.act(Action.B).cell == (7, 12)
        assert client.cell(arena_of(client)) == (7, 12)


def test_actions_stop_overlapping_where_ticks_are_not_as_expected() -> None:
    """At ten frames a second a hold is felt by an even number of ticks (FACTS: Walking); the journal says so."""
    client, notes = VirtualClient(seed=1, fps=10.0), Notes()
    arena = arena_of(client)
    with LiveGame(DIAMOND, Profile(arena=arena), connection_to(client, notes)) as game:
        checked = CheckedGame(game, ClientTruth(client, arena), DIAMOND, client.clock.now)
        counts = random_play(checked, range(120), np.random.default_rng(0), is_told=True)
        assert game.log.effort.overlapped < 30
    assert counts.is_right
    said = [str(facts["problem"]) for facts in notes.of("fails")]
    assert said
    assert all("a walk was not felt as planned" in problem for problem in said)
    waits = [int(problem.split(": ")[1].split()[0]) for problem in said]
    assert waits == sorted(waits)
    assert client.window.down == set()


@pytest.mark.parametrize("name", ["line", "diamond"])
@pytest.mark.parametrize("in_s", [0.85, 1.1, 1.35, 1.6, 1.85])
def test_a_refused_block_is_placed_again_once_it_is_seen_that_none_landed_elsewhere(name: str, in_s: float) -> None:
    client, scenario = VirtualClient(seed=3), load_scenario(name)
    with play(client, scenario) as game:
        warm(client, game)
        client.mishaps.plan("refused_placing", in_s)
        build_told(game, build(scenario))
    assert client.placed(arena_of(client)) == set(scenario.design)
    assert client.window.down == set()


def _knock(client: VirtualClient, _game: LiveGame) -> None:
    client.game.knock((0.3, 0.2, 0.3))


def _put_a_wall_ahead(client: VirtualClient, _game: LiveGame) -> None:
    """Put a block behind the agent, two cells on its way."""
    x, y = client.cell(arena_of(client))
    client.realm.world.put(arena_of(client).block_of((x, y - 2)), "stone")


def _empty_the_slot(client: VirtualClient, _game: LiveGame) -> None:
    client.realm.player.hotbar[client.realm.player.slot] = None


MISHAPS: dict[str, Mishap] = {
    "a push": _knock,
    "a wall": _put_a_wall_ahead,
    "a lost key": lambda client, _: client.window.drop_next(),
    "a late key": lambda client, _: client.window.delay_next(0.12),
    "a frame that stalls": lambda client, _: client.freeze(0.2),
    "a game that stalls": lambda client, _: client.stall(0.2),
    "another window": lambda client, _: client.set_front(is_in_front=False),
    "a turned view": lambda client, _: client.turn(40, 10),
    "an empty slot": _empty_the_slot,
    "the panic key": lambda _, game: game.connection.controller.stop("the panic key was pressed"),
}
GO_UNNOTICED = ("a lost key", "a late key")
"""What may come without a correction: the key may be the mouse's, on its way up."""

PHASES_S = [0.025 + 0.05 * tick for tick in range(10)]


@pytest.mark.parametrize("name", MISHAPS)
@pytest.mark.parametrize("in_s", PHASES_S)
def test_a_mishap_in_any_phase_is_noticed_and_recovered_from(name: str, in_s: float) -> None:
    """Every outcome that is reported was so in the world; what can't be made good ends the episode in an error."""
    client = VirtualClient(seed=7)
    arena = arena_of(client)
    actions = build(LINE)
    with play(client, LINE) as game:
        warm(client, game)
        corrected = game.log.effort.corrections
        client.clock.call_at(client.clock.now() + 1.2 + in_s, lambda: MISHAPS[name](client, game))
        truth, built, failed = ClientTruth(client, arena), set(), ""
        try:
            for action, following in pairwise(actions):
                outcome = game.act(action, None, (following, None))
                assert truth.passed(outcome.cell)
                built |= {outcome.placed} if outcome.placed else set()
                assert name == "a wall" or client.placed(arena) == built
        except LiveError as error:
            failed = str(error)
            assert client.window.down == set()
        assert failed or game.log.effort.corrections > corrected or name in GO_UNNOTICED
        if name in ("a wall", "an empty slot", "the panic key", "another window"):
            assert failed
        if name == "the panic key":
            with pytest.raises(StoppedError):
                game.reset(0)
            return
        client.set_front(is_in_front=True)
        assert game.reset(0) == LINE.start
        build_told(game, actions)
    assert client.placed(arena) == set(LINE.design)
    assert client.window.down == set()
    assert client.window.strays == []
