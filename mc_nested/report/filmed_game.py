"""A Game that is filmed as it is played: a picture after its reset, and one after each action."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.drawing import Picture
from mc_nested.arena.game import Following, Game, Outcome, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import THE_ARENA, Tally
from mc_nested.report.arena_picture import ARENA_PX, Moment, Size, beside, box_for, draw_moment
from mc_nested.report.film import Film

FIRST_S, STEP_S = 1.0, 0.5
"""Seconds for which a game without a clock of its own is shown before its first action, and after each."""


@dataclass(frozen=True)
class Window:
    """A running game's window.

    Args:
        picture: what it shows now, the chat blanked.
        now: the time in seconds, from an arbitrary zero; the film runs as fast as that.
    """

    picture: Callable[[], Picture]
    now: Callable[[], float]


class FilmedGame:
    """The same game, and every moment of its last episode in a film: a reset begins the film anew.

    Args:
        game: what is played.
        scenario: what is built in it.
        film: where the pictures go.
        window: the game's window, if it has one, shown beside the arena.
        arena_px: how large the arena is drawn.
    """

    def __init__(
        self, game: Game, scenario: Scenario, film: Film, window: Window | None = None, arena_px: int = ARENA_PX
    ) -> None:
        self._game, self._scenario, self._film, self._window = game, scenario, film, window
        self._arena_px = arena_px
        self._tally = Tally([scenario])
        self._placed: set[Cell] = set()
        self._steps, self._material = 0, 0
        self._began = 0.0
        self._box: Size | None = None
        self.objective: Cell | None = None
        """The cell that the agent is after from now on in this episode, if it has one: the film frames it."""

    @property
    def connection(self) -> object:
        """The filmed game's connection to its window; None if it has none."""
        return getattr(self._game, "connection", None)

    @property
    def resumable(self) -> None:
        """None: a film shows an episode from its beginning."""
        return None

    @property
    def log(self) -> PlayLog | None:
        return self._game.log

    def reset(self, material: int) -> Cell:
        cell = self._game.reset(material)
        if not self._film.is_empty:
            self._film.begin_anew()
        self._placed, self._steps, self._material, self._box = set(), 0, material, None
        self.objective = None
        self._tally.begin(THE_ARENA, np.array([material]))
        self._began = self._window.now() if self._window else 0.0
        self._show(cell)
        return cell

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        outcome = self._game.act(action, material, following)
        self._steps += 1
        if material is not None:
            self._material = material
            self._tally.take(THE_ARENA, np.array([material]))
        if outcome.placed is not None:
            if len(self._placed) < self._scenario.blocks:  # what is placed after the episode's end earns nothing
                x, y = outcome.placed
                self._tally.lay(THE_ARENA, np.array([x]), np.array([y]))
            self._placed.add(outcome.placed)
        self._show(outcome.cell)
        return outcome

    def _show(self, cell: Cell) -> None:
        simulated_s = FIRST_S + (self._steps - 1) * STEP_S if self._steps else 0.0
        at = self._window.now() - self._began if self._window else simulated_s
        score = float(self._tally.total(THE_ARENA)[0])
        moment = Moment(cell, self._placed, self._steps, self._material, score, self.objective)
        picture = draw_moment(self._scenario, moment, self._arena_px)
        if self._window:
            window = self._window.picture()
            self._box = self._box or box_for(window, self._arena_px)
            picture = beside(picture, window, self._box)
        self._film.show(picture, at)
