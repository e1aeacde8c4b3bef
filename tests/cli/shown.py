"""The cells that the agent is after, as a verb shows them: in the arena, in a view and in a film."""

from typing import NamedTuple

import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.report import terminal
from mc_nested.report.film import EpisodeFilm
from mc_nested.view.board import Board


class Shown(NamedTuple):
    """The cells that were drawn in the terminal, published for a view, and framed in a film."""

    drawn: list[Cell | None]
    published: list[Cell | None]
    filmed: list[Cell | None]


def objectives_shown(monkeypatch: pytest.MonkeyPatch) -> Shown:
    """Return what is shown from here on."""
    shown = Shown([], [], [])
    view, show, film_show = terminal.arena_view, Board.show, EpisodeFilm.show

    def arena_view(scenario: Scenario, agent: Cell, placed: frozenset[Cell], objective: Cell | None) -> object:
        shown.drawn.append(objective)
        return view(scenario, agent, placed, objective)

    def board_show(board: Board, **fields: object) -> None:
        if "arena" in fields:
            shown.published.append(fields["arena"].objective)  # type: ignore[attr-defined]  # an ArenaSeen
        show(board, **fields)

    def filmed(film: EpisodeFilm, env: ArenaEnv, objective: Cell | None) -> None:
        shown.filmed.append(objective)
        film_show(film, env, objective)

    monkeypatch.setattr("mc_nested.cli.watching.arena_view", arena_view)
    monkeypatch.setattr(Board, "show", board_show)
    monkeypatch.setattr(EpisodeFilm, "show", filmed)
    return shown
