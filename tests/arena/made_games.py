"""Games made for tests: one that holds whoever plays it to what was announced, and one in which a person acts."""

from dataclasses import replace

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario import Scenario
from sim.grid import GridGame

PERSON = (Action.R, Action.FD)
"""What a person does in the first two steps of each episode."""


class PlayedByAPerson(GridGame):
    """The rules; in the first two steps of the first ``episodes``, a person acts in place of whoever plays."""

    def __init__(self, scenario: Scenario, episodes: int) -> None:
        super().__init__(scenario)
        self._episodes, self._left = episodes, list[Action]()

    def reset(self, material: int) -> Cell:
        self._left = list(PERSON) if self._episodes else []
        self._episodes = max(0, self._episodes - 1)
        return super().reset(material)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        if not self._left:
            return super().act(action, material, following)
        done = self._left.pop(0)
        return replace(super().act(done, material), instead=done)


class TakesAtItsWord(GridGame):
    """The rules, and an AssertionError where something else is asked for than was announced.

    ``acts`` are the actions of all episodes, ``kept`` those of them that were announced. ``told`` is what each was told
    follows, and ``following`` what is announced now.
    """

    def __init__(self, scenario: Scenario) -> None:
        super().__init__(scenario)
        self.following: Following | None = None
        self.told = list[Following | None]()
        self.episodes = self.acts = self.kept = 0

    def reset(self, material: int) -> Cell:
        assert self.following is None, "nothing follows the last action of an episode"
        self.episodes += 1
        return super().reset(material)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        assert self.following in (None, (action, material)), f"{self.following} was announced"
        self.acts, self.kept = self.acts + 1, self.kept + (self.following is not None)
        self.following = following
        self.told.append(following)
        return super().act(action, material)
