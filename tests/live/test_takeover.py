"""Taking over: what a player does by hand is what the game says, and nothing of ours is pressed meanwhile."""

from collections import deque
from collections.abc import Callable, Collection
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, LiveError, StoppedError, TakenOverError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Button, Devices, Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.input.stops import Takeover
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.tables import GameVersion, Profile, WorldTable
from scripts.benches.person import REST_S, Hands, Script, clumsy
from sim.client.client import VirtualClient
from sim.client.game.screens import ScreenName
from tests.sim.client.playing import arena_of, screen_of, world_in

DIAMOND = load_scenario("diamond")
STONE = DIAMOND.best_material


class Watched:
    """A keyboard and mouse of the agent's: what is down of them, and what went down while it must not."""

    def __init__(self, client: VirtualClient) -> None:
        self._client = client
        self.down: set[str] = set()
        self.is_forbidden = False
        self.forbidden: list[str] = []

    def devices(self) -> Devices:
        return replace(self._client.devices, keyboard=_Keyboard(self, self._client), pointer=_Mouse(self, self._client))

    def pressed(self, name: str) -> None:
        self.down.add(name)
        self.forbidden += [name] * self.is_forbidden


class _Keyboard:
    def __init__(self, watched: Watched, client: VirtualClient) -> None:
        self._watched, self._keyboard = watched, client.keyboard

    def go_by_symbols(self, keys: Collection[str]) -> None:
        self._keyboard.go_by_symbols(keys)

    def press(self, key: str) -> None:
        self._watched.pressed(key)
        self._keyboard.press(key)

    def release(self, key: str) -> None:
        self._watched.down.discard(key)
        self._keyboard.release(key)

    def type(self, text: str) -> None:
        self._watched.forbidden += [text] * self._watched.is_forbidden
        self._keyboard.type(text)


class _Mouse:
    def __init__(self, watched: Watched, client: VirtualClient) -> None:
        self._watched, self._pointer = watched, client.pointer
        self.position, self.move = client.pointer.position, client.pointer.move

    def press(self, button: Button) -> None:
        self._watched.pressed(button)
        self._pointer.press(button)

    def release(self, button: Button) -> None:
        self._watched.down.discard(button)
        self._pointer.release(button)


class Table:
    """A virtual client with an agent and a person at it."""

    def __init__(self, seed: int = 0, client: VirtualClient | None = None, world: WorldTable | None = None) -> None:
        self.client = client or VirtualClient(seed=seed)
        self.arena = arena_of(self.client)
        version = GameVersion(version=self.client.settings.version)
        self.profile = Profile(game=version, arena=self.arena, world=world)
        self.said: list[str] = []
        self.ours = Watched(self.client)
        devices = self.ours.devices()
        self.controller = InputController(devices, self.profile.input)
        connection = GameConnection(devices, self.controller, screen_of(self.client))
        self.is_stopped = False
        takeover = Takeover(say=self._say, is_stopped=lambda: self.is_stopped)
        self.game = LiveGame(DIAMOND, self.profile, connection, takeover=takeover)
        self.hands = Hands(self.client, self.arena)
        self.is_players = False

    def _say(self, line: str) -> None:
        """Take note of a line; after the one that says so, a reset may press keys."""
        self.said.append(line)
        self.ours.is_forbidden = self.is_players and "hands off" not in line

    def switch_over(self) -> None:
        """Press the key that takes over, and gives back."""
        self.is_players = not self.is_players
        self.controller.switch_over()
        if self.is_players:
            assert self.ours.down == set()
        self.ours.is_forbidden = self.is_players

    def take_over(self, script: Callable[[Hands], Script]) -> None:
        """Let the person take over, do what the script says, and give back."""
        self.switch_over()
        self.hands.play(script(self.hands), self.switch_over)

    def until_given_back(self, asked: Action = Action.F) -> list[Outcome]:
        """Ask for one action after the other, and return what came in place of each."""
        outcomes = []
        while (outcome := self.game.act(asked)).instead is not None:
            outcomes.append(outcome)
        self.last = outcome
        return outcomes

    @property
    def truth(self) -> tuple[Cell, set[Cell]]:
        return self.client.cell(self.arena), self.client.placed(self.arena)


def check_said(outcomes: list[Outcome], cell: Cell, placed: set[Cell]) -> Cell:
    """Check that outcomes follow the rules from there on; add their blocks, and return where they end."""
    for outcome in outcomes:
        assert outcome.instead is not None
        cell = moved(cell, outcome.instead, placed, DIAMOND.size)
        assert outcome == Outcome(cell, landing(cell, outcome.instead, placed, DIAMOND.size), outcome.instead)
        placed |= {outcome.placed} if outcome.placed else set()
    return cell


@pytest.mark.parametrize("action", Action)
def test_each_of_the_eight_actions_is_recognized_when_a_person_does_it(action: Action) -> None:
    table = Table()
    table.game.reset(STONE)
    for _ in range(2):
        table.game.act(Action.B)
    table.take_over(lambda hands: hands.do([action]))
    (outcome,) = table.until_given_back(Action.B)
    assert outcome.instead == action
    placed = set[Cell]()
    cell = check_said([outcome], (7, 12), placed)
    assert table.last == Outcome(moved(cell, Action.B, placed, DIAMOND.size), None)
    assert table.truth == (table.last.cell, placed)


def test_a_clumsy_build_by_hand_is_told_action_by_action() -> None:
    table = Table()
    cell, placed = table.game.reset(STONE), set[Cell]()
    actions = clumsy(DIAMOND, 3)
    table.take_over(lambda hands: hands.do(actions))
    outcomes = table.until_given_back()
    assert [each.instead for each in outcomes] == actions
    check_said(outcomes, cell, placed)
    assert table.truth[1] == placed
    assert len(placed) == DIAMOND.blocks


actions = st.sampled_from(list(Action))


@given(
    st.integers(0, 2**16),
    st.lists(actions, min_size=8, max_size=8),
    st.floats(0.0, 2.5),
    st.lists(actions, max_size=3),
    st.booleans(),
)
def test_taking_over_at_any_time_leaves_nothing_down_and_every_outcome_true(
    seed: int, asked: list[Action], after_s: float, by_hand: list[Action], is_told: bool
) -> None:
    table = Table(seed)

    def script(hands: Hands) -> Script:
        yield from hands.settle()
        yield from hands.do(by_hand)

    cell, placed = table.game.reset(STONE), set[Cell]()
    clock = table.client.clock
    clock.call_at(clock.now() + after_s, lambda: table.take_over(script))
    plan, is_agents = deque(asked), False
    while plan or not (table.hands.has_done and is_agents):
        action = plan.popleft() if plan else Action.B
        following = (plan[0], None) if plan and is_told else None
        outcome = table.game.act(action, None, following)
        is_agents = outcome.instead is None
        done = action if outcome.instead is None else outcome.instead
        cell = moved(cell, done, placed, DIAMOND.size)
        block = landing(cell, done, placed, DIAMOND.size)
        assert (outcome.cell, outcome.placed) == (cell, block)
        placed |= {block} if block else set()
    assert table.truth == (cell, placed)
    assert table.ours.forbidden == []


def test_an_agent_goes_on_from_where_the_person_stands_however_they_look() -> None:
    table = Table()
    cell, placed = table.game.reset(STONE), set[Cell]()

    def turned_walk(hands: Hands) -> Script:
        yield from hands.turn(-90)  # to the left, which forward then leads to
        yield from hands.hold(9, "w")
        yield from hands.turn(30, -40)
        yield from hands.tap("5")

    table.take_over(turned_walk)
    outcomes = table.until_given_back(Action.BD)
    assert [each.instead for each in outcomes] == [Action.L, Action.L]
    cell = check_said(outcomes, cell, placed)
    assert table.last == Outcome((5, 13), (5, 14))
    assert table.truth == ((5, 13), {(5, 14)})


def test_a_game_given_back_at_once_does_what_it_was_asked_for() -> None:
    table = Table()
    table.game.reset(STONE)
    table.take_over(lambda hands: hands.turn(20))
    assert table.until_given_back(Action.B) == []
    assert table.last == Outcome((7, 13), None)


def test_a_block_placed_without_a_move_is_told_as_a_step_away_and_back() -> None:
    table = Table()
    table.game.reset(STONE)
    table.game.act(Action.B)
    table.take_over(lambda hands: hands.click())
    outcomes, placed = table.until_given_back(Action.B), set[Cell]()
    assert check_said(outcomes, (7, 13), placed) == (7, 13)
    assert placed == {(7, 14)}
    assert len(outcomes) == 2


def placing_another_material(hands: Hands) -> Script:
    yield from hands.tap("1")
    yield from hands.do([Action.BD])


def breaking_a_block(hands: Hands) -> Script:
    yield REST_S
    yield from hands.click("left")
    yield REST_S


def placing_beside(hands: Hands) -> Script:
    yield from hands.turn(-90)
    yield from hands.click()


def breaking_the_floor(hands: Hands) -> Script:
    yield from hands.turn(90)
    yield from hands.click("left")
    yield from hands.turn(0, 1)


@pytest.mark.parametrize(
    ("script", "complaint"),
    [
        (placing_another_material, r"oak_planks was placed at \(7, 13\), not minecraft:stone: take that in hand"),
        (breaking_a_block, r"the block at \(7, 14\) was broken"),
        (placing_beside, r"a block was placed at \(6, 13\), not in front of you at \(7, 13\)"),
        (breaking_the_floor, r"the floor at \(8, 13\) was broken"),
    ],
)
def test_what_no_action_can_say_ends_the_episode_in_one_line(script: Callable[[Hands], Script], complaint: str) -> None:
    table = Table()
    table.game.reset(STONE)
    assert table.game.act(Action.BD).placed == (7, 14)
    table.take_over(script)
    with pytest.raises(LiveError, match=complaint):
        table.until_given_back()
    assert table.ours.down == set()
    assert table.game.reset(STONE) == DIAMOND.start == table.client.cell(table.arena)
    assert table.ours.forbidden == []


def test_a_player_who_leaves_the_arena_is_told_what_to_do_and_may_come_back() -> None:
    table = Table()
    table.game.reset(STONE)

    def out_and_back(hands: Hands) -> Script:
        yield from hands.hold(5, "w")
        yield from hands.hold(10, "s")

    table.take_over(out_and_back)
    outcomes = table.until_given_back(Action.L)
    assert [each.instead for each in outcomes] == [Action.B]
    assert table.said == [
        "You play now: give back with f9.",
        "You have left the arena: come back, or give back with f9.",
        "The agent plays again.",
    ]


def test_a_game_given_back_outside_the_arena_ends_the_episode() -> None:
    table = Table()
    table.game.reset(STONE)
    table.take_over(lambda hands: hands.hold(5, "w"))
    with pytest.raises(LiveError, match="the game was given back outside the arena"):
        table.until_given_back()
    assert table.game.reset(STONE) == DIAMOND.start


def test_a_reset_borrows_the_game_from_the_player_who_gets_it_again() -> None:
    table = Table()
    table.game.reset(STONE)
    table.switch_over()
    table.hands.play(table.hands.do([Action.BD, Action.B]))
    while table.game.act(Action.F).placed is None:
        pass
    table.game.reset(STONE)
    assert table.truth == (DIAMOND.start, set())
    assert table.said == [
        "You play now: give back with f9.",
        "The episode is over: hands off while the arena is reset.",
        "The arena is reset: it is yours again.",
    ]
    table.hands.play(table.hands.do([Action.LD]), table.switch_over)
    assert [each.instead for each in table.until_given_back(Action.B)] == [Action.L]
    assert table.ours.forbidden == []


def test_taking_over_during_a_reset_stops_it_until_the_game_is_given_back() -> None:
    table = Table()
    clock = table.client.clock
    clock.call_at(clock.now() + 0.4, table.switch_over)
    clock.call_at(clock.now() + 5.4, table.switch_over)
    began = clock.now()
    assert table.game.reset(STONE) == DIAMOND.start == table.client.cell(table.arena)
    assert clock.now() - began > 5.4
    assert table.said == ["The arena is only half reset: close the chat, give back with f9, and it is done again."]
    assert table.ours.forbidden == []
    assert table.game.act(Action.B) == Outcome((7, 13), None)


def test_taking_over_anew_during_a_borrowed_reset_stops_it_too() -> None:
    table = Table()
    table.game.reset(STONE)
    table.switch_over()
    clock = table.client.clock
    for in_s in (1.5, 1.6, 4.0):
        clock.call_at(clock.now() + in_s, table.switch_over)
    table.game.reset(STONE)
    assert table.ours.forbidden == []
    assert table.said[-1].startswith("The arena is only half reset")
    assert table.game.act(Action.B) == Outcome((7, 13), None)


def test_the_panic_key_ends_a_game_that_the_player_has() -> None:
    table = Table()
    table.game.reset(STONE)
    table.switch_over()
    clock = table.client.clock
    clock.call_at(clock.now() + 1.0, lambda: table.controller.stop("the panic key was pressed"))
    with pytest.raises(StoppedError):
        table.game.act(Action.B)


def test_a_stop_of_the_run_does_not_wait_for_the_player() -> None:
    table = Table()
    table.game.reset(STONE)
    table.switch_over()
    clock = table.client.clock
    clock.call_at(clock.now() + 1.0, lambda: setattr(table, "is_stopped", True))
    with pytest.raises(TakenOverError, match="the run was stopped while the player had the game"):
        table.game.act(Action.B)


@pytest.mark.parametrize("screen", ["chat", "pause", "inventory"])
def test_a_screen_that_the_player_opens_is_left_to_them(screen: ScreenName) -> None:
    table = Table()
    table.game.reset(STONE)

    def elsewhere(hands: Hands) -> Script:
        table.client.game.open(screen)
        yield 3.0
        assert table.client.game.screen == screen
        yield from hands.tap("esc")
        yield from hands.do([Action.BD])

    table.take_over(elsewhere)
    assert [each.instead for each in table.until_given_back(Action.B)] == [Action.BD]


def test_a_player_may_look_at_another_window_meanwhile() -> None:
    table = Table()
    table.game.reset(STONE)

    def away(hands: Hands) -> Script:
        table.client.controls.pauses_unfocused = False
        table.client.set_front(is_in_front=False)
        yield 30.0
        table.client.set_front(is_in_front=True)
        yield from hands.do([Action.L])

    table.take_over(away)
    assert [each.instead for each in table.until_given_back(Action.B)] == [Action.L]
    assert table.client.window.strays == []


def test_a_window_that_is_closed_while_the_player_has_the_game_is_one_line() -> None:
    table = Table()
    table.game.reset(STONE)
    table.switch_over()
    gone = "the game's window is gone: open it again"

    def close() -> None:
        def refuse(_: object = None) -> Frame:
            raise DesktopError(gone)

        vars(table.client.display)["grab"] = refuse

    table.client.clock.call_at(table.client.clock.now() + 1.0, close)
    with pytest.raises(DesktopError, match=gone):
        table.game.act(Action.B)
    assert table.ours.down == set()


def test_without_cheats_the_player_turns_the_view_back_before_the_agent_goes_on(tmp_path: Path) -> None:
    folder = tmp_path / "saves" / "arena"
    client = VirtualClient(has_cheats=False, world_folder=folder)
    client.clock.sleep(0.2)
    table = Table(client=client, world=world_in(client, DIAMOND, folder))
    cell, placed = table.game.reset(STONE), set[Cell]()

    def turned(hands: Hands) -> Script:
        yield from hands.do([Action.BD])
        yield from hands.turn(40)
        table.switch_over()
        yield 3.0
        yield from hands.turn(-40)

    began = client.clock.now()
    table.switch_over()
    table.hands.play(turned(table.hands))
    cell = check_said(table.until_given_back(Action.B), cell, placed)
    assert client.clock.now() - began > 3.0
    assert table.said == [
        "You play now: give back with f9.",
        "Before the agent can go on: the view is 40 / 65, not 0 / 65.",
        "The agent plays again.",
    ]
    assert table.last == Outcome((7, 12), None)
    assert table.truth == ((7, 12), {(7, 14)})
