"""Taking over: what a player does by hand is what the game says, and nothing of ours is pressed meanwhile."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.input.stops import Takeover
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from tests.live.person import Hands, Script, clumsy
from tests.sim.client.playing import arena_of, connection_to

DIAMOND = load_scenario("diamond")
STONE = DIAMOND.best_material


class Table:
    """A virtual client with an agent and a person at it."""

    def __init__(self, seed: int = 0) -> None:
        self.client = VirtualClient(seed=seed)
        self.arena = arena_of(self.client)
        profile = Profile(game=GameVersion(version=self.client.settings.version), arena=self.arena)
        self.said: list[str] = []
        connection = connection_to(self.client)
        self.game = LiveGame(DIAMOND, profile, connection, takeover=Takeover(say=self.said.append))
        self.controller = connection.controller
        self.hands = Hands(self.client, self.arena)
        self.ours = 0

    def take_over(self, script: Callable[[Hands], Script]) -> None:
        """Let the person take over, do what the script says, and give back."""
        self.controller.switch_over()
        self.hands.play(script(self.hands), self.controller.switch_over)

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
