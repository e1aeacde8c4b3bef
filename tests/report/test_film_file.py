"""A .gif by Pillow and an .mp4 by ffmpeg, which never outlives the film, and what is said when it gives up."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mc_nested.arena.drawing import COLOURS, draw_picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import FilmError
from mc_nested.report.film import open_film
from mc_nested.report.film_file import GifEncoder, Mp4Encoder
from tests.report.films import BLUE, GREEN, RED, pictures_of, shown

LINE = load_scenario("line")


def test_a_repeated_picture_is_shown_longer(tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    encoder = GifEncoder(path, 10)
    for picture, count in ((RED, 3), (RED.copy(), 2), (GREEN, 1)):
        encoder.add(picture, count)
    encoder.finish()
    assert [seconds for _, seconds in pictures_of(path)] == [0.5, 0.1]


def test_a_gif_repeats_for_ever(tmp_path: Path) -> None:
    encoder = GifEncoder(tmp_path / "film.gif", 10)
    encoder.add(RED, 1)
    encoder.add(GREEN, 1)
    encoder.finish()
    with Image.open(tmp_path / "film.gif") as image:
        assert image.info["loop"] == 0


def test_a_noisy_window_does_not_distort_the_arenas_colours(tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    arena = draw_picture(LINE, LINE.start, {(7, 5), (0, 0)}, 16)
    noise = np.random.default_rng(0).integers(0, 255, (240, 900, 3)).astype(np.uint8)
    encoder = GifEncoder(path, 10)
    encoder.add(np.concatenate([arena, noise], axis=1), 1)
    encoder.finish()
    ((kept, _),) = pictures_of(path)
    flat = (arena[:, :, None] == np.array(COLOURS)).all(axis=3).any(axis=2)
    assert flat.mean() > 0.9
    assert np.abs(kept[:, :240].astype(int) - arena)[flat].max() <= 8


def test_colours_of_later_pictures_are_shown_closely_too(tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    shown = [draw_picture(LINE, LINE.start, placed, 24) for placed in ((), {(7, 5)}, {(7, 5), (0, 0)})]
    encoder = GifEncoder(path, 10)
    for picture in shown:
        encoder.add(picture, 1)
    encoder.finish()
    for (kept, _), picture in zip(pictures_of(path), shown, strict=True):
        assert np.abs(kept.astype(int) - picture).max() <= 12


def test_the_error_holds_ffmpegs_message_when_a_film_can_not_be_written(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "none" / "film.mp4", 10)
    encoder.add(RED, 3)
    with pytest.raises(OSError, match="No such file or directory"):
        encoder.finish()
    encoder.stop()


def test_a_film_whose_ffmpeg_was_killed_raises_and_leaves_no_file(tmp_path: Path) -> None:
    def play() -> None:
        with open_film(tmp_path / "film.mp4") as film:
            film.show(RED, 0.0)
            film.show(RED, 0.1)
            encoder = film._encoder
            assert isinstance(encoder, Mp4Encoder)
            assert encoder._ffmpeg
            encoder._ffmpeg.kill()
            encoder._ffmpeg.wait()
            for number in range(2, 200):
                film.show(RED, number / 10)

    with pytest.raises(FilmError, match="ffmpeg ended without a word"):
        play()
    assert list(tmp_path.iterdir()) == []


def test_stopping_a_film_ends_ffmpeg(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "film.mp4", 10)
    encoder.add(RED, 3)
    ffmpeg = encoder._ffmpeg
    encoder.stop()
    assert ffmpeg is not None
    assert ffmpeg.poll() is not None
    encoder.stop()


def test_finishing_a_film_without_pictures_writes_nothing(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "film.mp4", 10)
    encoder.finish()
    encoder.stop()
    assert list(tmp_path.iterdir()) == []


def test_stopping_a_finished_film_leaves_the_film_complete(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    encoder = Mp4Encoder(path, 10)
    encoder.add(RED, 5)
    encoder.add(BLUE, 10)
    encoder.finish()
    encoder.stop()
    assert shown(path) == [("r", 0.5), ("b", 1.0)]
