"""``--video``: a film of an episode, in the simulator, in a window, and of an episode that ends early."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.drawing import Picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.cli.watching import filmed
from mc_nested.errors import LiveError, StoppedError
from mc_nested.live.recording.replayed_run import replay
from mc_nested.live.session import open_live_game
from mc_nested.live.vision.chat_region import BLANK
from mc_nested.report.arena_picture import CAPTION, MARGIN, SMALL_ARENA_PX
from sim.client.client import VirtualClient
from sim.grid import GridGame
from tests.cli.fragile_game import open_live
from tests.cli.running import run
from tests.live.virtual_session import opening_on, profile_in
from tests.report.films import pictures_of
from tests.sim.client.playing import FONT

LINE = load_scenario("line")


@pytest.mark.parametrize("kind", [".mp4", ".gif"])
def test_play_films_its_episode(kind: str, optimal: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    film = tmp_path / f"film{kind}"
    assert run("play", optimal, "--video", film) == 0
    assert f"film: {film}" in capsys.readouterr().out
    pictures = pictures_of(film)
    assert 6.0 < sum(seconds for _, seconds in pictures) < 12.0
    assert (np.abs(pictures[0][0].astype(int) - pictures[-1][0]) > 60).any()
    assert list(tmp_path.iterdir()) == [film]


def test_build_films_every_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    film = tmp_path / "film.gif"
    assert run("build", "zigzag", "--video", film) == 0
    assert f"film: {film}" in capsys.readouterr().out
    assert len(pictures_of(film)) == 26


def played(optimal: Path, film: Path) -> int:
    return run("play", optimal, "--backend", "live", "--profile", "mine", "--video", film)


def test_stopped_episode_leaves_a_film_of_the_steps_played(
    optimal: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 5, StoppedError("stopped by f12"), 1)
    film = tmp_path / "film.gif"
    assert played(optimal, film) == 2
    said = capsys.readouterr().err.splitlines()
    assert said[-2:] == [f"film of what was played: {film}", "mc-nested: stopped by f12"]
    assert 1 <= len(pictures_of(film)) <= 6


def test_an_episode_that_starts_over_is_filmed_from_its_new_start(
    optimal: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    straight, again = tmp_path / "straight.gif", tmp_path / "again.gif"
    open_live(monkeypatch, float("inf"))
    assert played(optimal, straight) == 0
    open_live(monkeypatch, 5, LiveError("it lagged"), 1)
    assert played(optimal, again) == 0
    assert "it lagged; the episode starts over" in capsys.readouterr().err
    # Where steps take no time, a film keeps but the last moment: the same, however it came about.
    assert np.abs(pictures_of(again)[-1][0].astype(int) - pictures_of(straight)[-1][0]).mean() < 0.5


def test_a_game_that_never_begins_leaves_no_film_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = tmp_path / "film.gif"
    with pytest.raises(LiveError), filmed(GridGame(LINE), None, film):
        raise LiveError("the game is gone")
    assert capsys.readouterr().err == "there is no film\n"
    assert list(tmp_path.iterdir()) == []


def test_there_is_no_film_if_none_is_asked_for() -> None:
    with filmed(GridGame(LINE), None, None) as film:
        assert film is None


def window_of(picture: Picture) -> Picture:
    """Return the part of a film's picture that shows the window."""
    return picture[CAPTION : CAPTION + SMALL_ARENA_PX, SMALL_ARENA_PX + 2 * MARGIN : -MARGIN]


def film_of(client: VirtualClient, folder: Path, *actions: Action) -> list[Picture]:
    """Return the pictures of a film of what is played on that client, and recorded."""
    path = folder / "film.gif"
    opening = replace(opening_on(client, profile_in(folder)), record=folder / "recording")
    with open_live_game(LINE, opening) as (game, display), filmed(game, display, path) as film:
        assert film
        env = ArenaEnv(game, LINE)
        env.reset()
        film.show(env, None)
        for action in actions:
            env.step(action)
            film.show(env, None)
    return [picture for picture, _ in pictures_of(path)]


def test_a_films_window_shows_the_game_but_never_the_chat(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (*_, picture) = film_of(VirtualClient(scale=1), tmp_path, Action.BD)
    window = window_of(picture)
    assert window.shape[:2] == (SMALL_ARENA_PX, round(SMALL_ARENA_PX * 854 / 480))
    # At GUI scale 1 the chat takes 332 of 854 columns and the rows from 252 on, and all of the last 38.
    chat = window[round(SMALL_ARENA_PX * 254 / 480) :, : round(SMALL_ARENA_PX * 330 / 480)]
    typed = window[round(SMALL_ARENA_PX * 444 / 480) :]
    for blanked in (chat, typed):
        assert (np.abs(blanked.astype(int) - BLANK) <= 8).all()
    assert np.ptp(window[: round(SMALL_ARENA_PX * 240 / 480)]) > 100
    assert replay(tmp_path / "recording", FONT).differences == []
    assert capsys.readouterr().err == ""


def test_a_window_that_is_mostly_chat_says_how_to_show_more(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    film_of(VirtualClient(scale=2), tmp_path)
    said = capsys.readouterr().err
    assert said.startswith("77% of the window is where the chat may be, and stays grey in the film: ")
    assert "a smaller GUI Scale, or a larger window, shows more" in said
