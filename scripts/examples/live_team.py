"""LiveTeam: the TeamGame that is played in k windows, each another player in the same world."""

from collections.abc import Sequence
from dataclasses import replace

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, action_with, others_of
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError
from mc_nested.live.live_game import LiveGame


def scenario_of(team: Team, builder: int) -> Scenario:
    """Return the team's scenario with that builder's start cell."""
    return replace(team.scenario, start=team.starts[builder])


class LiveTeam:
    """A team's arena in running games: each builder has a window, devices and a profile of its own.

    The builders act one after the other, by number, as the rules resolve a tick: on a virtual clock that is the same
    each time, and a tick takes as long as all its actions. If one fails, the arena must be reset.

    Args:
        team: who builds what.
        games: a game for each builder, by number, made for ``scenario_of(team, number)``; all in one world,
            their profiles marking the same arena.

    Raises:
        LiveError: there isn't a game for each builder.
    """

    resumable = None
    """A window's episode can't be saved half-way."""

    def __init__(self, team: Team, games: Sequence[LiveGame]) -> None:
        if len(games) != team.builders:
            raise LiveError(f"{team.builders} builders and {len(games)} running games: open one for each")
        self._team = team
        self._games = tuple(games)
        self._cells: list[Cell] | None = None
        self._placed: set[Cell] = set()

    def reset(self, material: int) -> tuple[Cell, ...]:
        """Reset each builder's game, by number: the first clears the arena, each stands on its own start cell."""
        self._cells = None
        cells = [game.reset(material) for game in self._games]
        self._cells, self._placed = cells, set()
        return tuple(cells)

    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        """Perform a tick; raise LiveError if an action fails, or the arena must be reset first."""
        if self._cells is None:
            raise LiveError("the arena must be reset first: the last reset or tick failed, or there was none")
        cells, self._cells = self._cells, None
        outcomes = [self._act(number, action, cells) for number, action in enumerate(actions)]
        self._cells = cells
        return tuple(outcomes)

    def _act(self, number: int, action: Action | None, cells: list[Cell]) -> Outcome:
        """Perform one builder's action, and take in the cells and blocks after it."""
        if action is None:
            return Outcome(cells[number], None)
        game = self._games[number]
        game.see_others(self._placed, others_of(cells, number))
        outcome = game.act(action_with(action, self._team.scenario.blocks - len(self._placed)))
        cells[number] = outcome.cell
        if outcome.placed is not None:
            self._placed.add(outcome.placed)
        return outcome
