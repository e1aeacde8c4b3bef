"""A .gif by Pillow: the colours of each picture, and how often it repeats."""

from pathlib import Path

import numpy as np
from PIL import Image

from mc_nested.arena.drawing import COLOURS, draw_picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.report.gif import GifEncoder
from tests.report.films import GREEN, RED, pictures_of

LINE = load_scenario("line")


def test_the_same_picture_again_is_shown_longer(tmp_path: Path) -> None:
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


def test_a_noisy_window_crowds_out_none_of_the_arenas_colours(tmp_path: Path) -> None:
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


def test_later_colours_are_shown_as_closely_as_the_first_ones(tmp_path: Path) -> None:
    path = tmp_path / "film.gif"
    shown = [draw_picture(LINE, LINE.start, placed, 24) for placed in ((), {(7, 5)}, {(7, 5), (0, 0)})]
    encoder = GifEncoder(path, 10)
    for picture in shown:
        encoder.add(picture, 1)
    encoder.finish()
    for (kept, _), picture in zip(pictures_of(path), shown, strict=True):
        assert np.abs(kept.astype(int) - picture).max() <= 12
