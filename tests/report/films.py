"""Reads films back."""

from pathlib import Path

import cv2
import numpy as np
from PIL import Image

from mc_nested.arena.drawing import Picture


def flat(colour: tuple[int, int, int], width: int = 32, height: int = 24) -> Picture:
    """Return a picture of one colour."""
    return np.full((height, width, 3), colour, dtype=np.uint8)


RED, GREEN, BLUE = (flat(colour) for colour in ((220, 30, 30), (30, 200, 30), (30, 30, 220)))


def strongest(picture: Picture) -> str:
    """Return the strongest colour of a picture."""
    return "rgb"[int(picture.mean(axis=(0, 1)).argmax())]


def shown(path: Path) -> list[tuple[str, float]]:
    """Return the strongest colour of a film's pictures, and how many seconds each is shown."""
    colours = [(strongest(picture), seconds) for picture, seconds in pictures_of(path)]
    runs: list[tuple[str, float]] = []
    for colour, seconds in colours:
        if runs and runs[-1][0] == colour:
            runs[-1] = (colour, round(runs[-1][1] + seconds, 3))
        else:
            runs.append((colour, round(seconds, 3)))
    return runs


def pictures_of(path: Path) -> list[tuple[Picture, float]]:
    """Return a film's pictures, and how many seconds each is shown."""
    if path.suffix == ".gif":
        found = []
        with Image.open(path) as image:
            for index in range(getattr(image, "n_frames", 1)):
                image.seek(index)
                found.append((np.asarray(image.convert("RGB")), image.info["duration"] / 1000))
        return found
    film = cv2.VideoCapture(str(path))
    each_s = 1 / film.get(cv2.CAP_PROP_FPS)
    frames = []
    while (read := film.read())[0]:
        frames.append((read[1][..., ::-1].astype(np.uint8), each_s))
    film.release()
    return frames
