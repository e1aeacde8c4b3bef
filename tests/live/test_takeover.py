"""Taking over: what a player does by hand is what the game says, and nothing of ours is pressed meanwhile."""

from collections import deque
from collections.abc import Callable, Collection
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Button, Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.input.stops import Takeover
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from tests.live.person import Hands, Script, clumsy
from tests.sim.client.playing import arena_of, screen_of

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

    def __init__(self, seed: int = 0, profile: Profile | None = None) -> None:
        self.client = VirtualClient(seed=seed)
        self.arena = arena_of(self.client)
        self.profile = profile or Profile(game=GameVersion(version=self.client.settings.version), arena=self.arena)
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
