"""An episode that is filmed: what is in the film, and when."""

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.drawing import Picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.report.arena_picture import beside, box_for, draw_moment
from mc_nested.report.film import FIRST_S, STEP_S, EpisodeFilm, Film, Window
from tests.arena.simulated import arena_env
from tests.report.films import flat


class NotedFilm(Film):
    """Keeps its pictures and times in a list, and writes nothing."""

    def __init__(self) -> None:
        self.shown: list[tuple[Picture, float]] = []

    def begin_anew(self) -> None:
        self.shown.clear()

    def show(self, picture: Picture, at: float) -> None:
        self.shown.append((picture, at))

    @property
    def times(self) -> list[float]:
        return [at for _, at in self.shown]


def begun(window: Window | None = None) -> tuple[NotedFilm, EpisodeFilm, ArenaEnv]:
    """Return a film, what shows a line's episode in it, and that episode, which was shown after its reset."""
    film, env = NotedFilm(), arena_env("line")
    episode = EpisodeFilm(film, window)
    env.reset()
    episode.show(env, None)
    return film, episode, env


def test_the_film_shows_the_start_and_every_step() -> None:
    film, episode, env = begun()
    moments = [draw_moment(env)]
    for action in (Action.B, Action.BD, Action.LD):
        env.step(action)
        episode.show(env, None)
        moments.append(draw_moment(env))
    for (picture, _), moment in zip(film.shown, moments, strict=True):
        np.testing.assert_array_equal(picture, moment)
    assert film.times == [0.0, FIRST_S, FIRST_S + STEP_S, FIRST_S + 2 * STEP_S]


def test_the_film_frames_the_cell_that_the_agent_is_after() -> None:
    film, episode, env = begun()
    env.step(Action.B)
    episode.show(env, (7, 13))
    np.testing.assert_array_equal(film.shown[-1][0], draw_moment(env, (7, 13)))
    assert (film.shown[-1][0] != draw_moment(env)).any()
    env.reset()
    episode.show(env, None)
    np.testing.assert_array_equal(film.shown[-1][0], draw_moment(env))


def test_a_film_of_building_eleven_blocks_takes_six_to_ten_seconds() -> None:
    film, episode, env = begun()
    for action in build(env.scenario):
        env.step(action)
        episode.show(env, None)
    assert 6.0 < film.times[-1] < 10.0


def test_an_episode_that_starts_over_begins_the_film_anew() -> None:
    film, episode, env = begun()
    env.step(Action.BD)
    episode.show(env, None)
    env.reset(options={"material": "wood"})
    episode.show(env, None)
    ((picture, at),) = film.shown
    np.testing.assert_array_equal(picture, draw_moment(env))
    assert at == 0.0


def test_the_window_is_shown_beside_the_arena_after_each_step_at_its_own_time() -> None:
    windows = [flat((1, 2, 3), 64, 36), flat((50, 60, 70), 64, 36), flat((0, 0, 9), 36, 64), flat((5, 0, 9), 36, 64)]
    pictures, times = iter(windows), iter([100.0, 100.4, 101.7, 103.0])
    film, episode, env = begun(Window(lambda: next(pictures), lambda: next(times)))
    moments = [draw_moment(env)]
    for _ in range(2):
        env.step(Action.B)
        episode.show(env, None)
        moments.append(draw_moment(env))
    assert film.times == pytest.approx([0.0, 0.4, 1.7])
    for (picture, _), moment, window in zip(film.shown, moments, windows[:3], strict=True):
        np.testing.assert_array_equal(picture, beside(moment, window, box_for(windows[0])))
    env.reset()
    episode.show(env, None)
    np.testing.assert_array_equal(film.shown[-1][0], beside(draw_moment(env), windows[3], box_for(windows[3])))
    assert film.times == [0.0]
