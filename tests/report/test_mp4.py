"""An .mp4 by ffmpeg: what is said when ffmpeg gives up, and that it never outlives the film."""

from pathlib import Path

import pytest

from mc_nested.errors import FilmError
from mc_nested.report.film import open_film
from mc_nested.report.mp4 import Mp4Encoder
from tests.report.films import BLUE, RED, shown


def test_ffmpegs_own_message_says_why_a_film_can_not_be_written(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "none" / "film.mp4", 10)
    encoder.add(RED, 3)
    with pytest.raises(OSError, match="No such file or directory"):
        encoder.finish()
    encoder.stop()


def test_a_film_whose_ffmpeg_is_gone_is_given_up_and_nothing_is_left(tmp_path: Path) -> None:
    def play() -> None:
        with open_film(tmp_path / "film.mp4") as film:
            film.show(RED, 0.0)
            film.show(RED, 0.1)
            ffmpeg = film._encoder._ffmpeg  # type: ignore[attr-defined]  # to kill it
            ffmpeg.kill()
            ffmpeg.wait()
            for number in range(2, 200):
                film.show(RED, number / 10)

    with pytest.raises(FilmError, match="ffmpeg ended without a word"):
        play()
    assert list(tmp_path.iterdir()) == []


def test_a_film_that_is_stopped_ends_ffmpeg(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "film.mp4", 10)
    encoder.add(RED, 3)
    ffmpeg = encoder._ffmpeg
    encoder.stop()
    assert ffmpeg is not None
    assert ffmpeg.poll() is not None
    encoder.stop()


def test_without_a_picture_there_is_nothing_to_end(tmp_path: Path) -> None:
    encoder = Mp4Encoder(tmp_path / "film.mp4", 10)
    encoder.finish()
    encoder.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_finished_film_is_whole_even_if_it_is_stopped_afterwards(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    encoder = Mp4Encoder(path, 10)
    encoder.add(RED, 5)
    encoder.add(BLUE, 10)
    encoder.finish()
    encoder.stop()
    assert shown(path) == [("r", 0.5), ("b", 1.0)]
