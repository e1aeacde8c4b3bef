"""A game that is filmed: what is in the film, when, and that it is the same game."""

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.drawing import Picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.report.arena_picture import Moment, beside, box_for, draw_moment
from mc_nested.report.film import FIRST_S, STEP_S, Film, FilmedGame, Window
from sim.grid import GridGame
from tests.arena.game_contract import BUMPS, check_following, check_game
from tests.report.films import flat

LINE = load_scenario("line")
STONE = LINE.best_material


class NotedFilm(Film):
    """Keeps its pictures and times in a list, and writes nothing."""

    def __init__(self) -> None:
        self.shown: list[tuple[Picture, float]] = []

    @property
    def is_empty(self) -> bool:
        return not self.shown

    def begin_anew(self) -> None:
        self.shown.clear()

    def show(self, picture: Picture, at: float) -> None:
        self.shown.append((picture, at))

    @property
    def times(self) -> list[float]:
        return [at for _, at in self.shown]


def begun() -> tuple[NotedFilm, FilmedGame]:
    film = NotedFilm()
    game = FilmedGame(GridGame(LINE), LINE, film)
    game.reset(STONE)
    return film, game


def test_a_filmed_game_behaves_as_the_game_itself() -> None:
    check_game(FilmedGame(GridGame(LINE), LINE, NotedFilm()), LINE, [*BUMPS, *build(LINE)])
    check_following(FilmedGame(GridGame(LINE), LINE, NotedFilm()), LINE, [*BUMPS, *build(LINE)])


def test_the_film_shows_the_start_and_every_step() -> None:
    film, game = begun()
    for action in (Action.B, Action.BD, Action.LD):
        game.act(action)
    moments = [
        Moment((7, 14), (), 0, STONE, 10.0),
        Moment((7, 13), (), 1, STONE, 10.0),
        Moment((7, 12), {(7, 13)}, 2, STONE, 10.0),
        Moment((6, 12), {(7, 13), (6, 13)}, 3, STONE, 10.0),
    ]
    for (picture, _), moment in zip(film.shown, moments, strict=True):
        np.testing.assert_array_equal(picture, draw_moment(LINE, moment))
    assert film.times == [0.0, FIRST_S, FIRST_S + STEP_S, FIRST_S + 2 * STEP_S]


def test_the_film_frames_what_the_agent_is_after_until_the_next_episode() -> None:
    film, game = begun()
    game.objective = (7, 13)
    game.act(Action.B)
    framed = draw_moment(LINE, Moment((7, 13), (), 1, STONE, 10.0, (7, 13)))
    np.testing.assert_array_equal(film.shown[-1][0], framed)
    assert (framed != draw_moment(LINE, Moment((7, 13), (), 1, STONE, 10.0))).any()
    game.reset(STONE)
    np.testing.assert_array_equal(film.shown[-1][0], draw_moment(LINE, Moment((7, 14), (), 0, STONE, 10.0)))


def test_a_film_of_building_eleven_blocks_takes_six_to_ten_seconds() -> None:
    film, game = begun()
    for action in build(LINE):
        game.act(action)
    assert 6.0 < film.times[-1] < 10.0


def test_an_episode_that_starts_over_begins_the_film_anew() -> None:
    film, game = begun()
    game.act(Action.BD)
    game.reset(0)
    ((picture, at),) = film.shown
    np.testing.assert_array_equal(picture, draw_moment(LINE, Moment((7, 14), (), 0, 0, -5.0)))
    assert at == 0.0


def test_the_window_is_shown_beside_the_arena_after_each_step_at_its_own_time() -> None:
    windows = [flat((1, 2, 3), 64, 36), flat((50, 60, 70), 64, 36), flat((0, 0, 9), 36, 64)]
    pictures, times = iter(windows), iter([100.0, 100.0, 100.4, 101.7])
    film = NotedFilm()
    game = FilmedGame(GridGame(LINE), LINE, film, Window(lambda: next(pictures), lambda: next(times)))
    game.reset(STONE)
    game.act(Action.B)
    game.act(Action.B)
    assert film.times == pytest.approx([0.0, 0.4, 1.7])
    box = box_for(windows[0])
    for step, (picture, _) in enumerate(film.shown):
        moment = draw_moment(LINE, Moment((7, 14 - step), (), step, STONE, 10.0))
        np.testing.assert_array_equal(picture, beside(moment, windows[step], box))


def test_a_filmed_game_is_not_resumable_and_has_no_log() -> None:
    assert FilmedGame(GridGame(LINE), LINE, NotedFilm()).resumable is None
    assert FilmedGame(GridGame(LINE), LINE, NotedFilm()).log is None
