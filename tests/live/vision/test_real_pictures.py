"""Pictures of the real game: a user's own, where a folder of them is named, and how that folder is read."""

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import font_of
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.f3_screen import F3Screen
from tests.live.vision.real_pictures import TRUTH, VARIABLE, differences, truths

ROOT = Path(__file__).parents[3]
FOLDER = os.environ.get(VARIABLE)

if FOLDER:  # without a folder there is nothing to read: the head of the test report says so

    @pytest.mark.parametrize("truth", truths(Path(FOLDER)), ids=lambda truth: str(truth["file"]))
    def test_a_picture_of_the_real_game_is_read_right(truth: dict[str, Any]) -> None:
        assert list(differences(Path(FOLDER or ""), truth)) == []


SHOWN = F3Screen("1.19.3-1.21.8", 2, (8.5, 64.0, -3.25), 0.0, 65.0, Target((8, 63, -2), "minecraft:stone"))


def folder_of(path: Path, **changes: Any) -> Path:
    """Return a folder of two painted pictures and their truths, the first one changed."""
    cv2.imwrite(str(path / "ascii.png"), drawn_atlas())
    about = {"font": "ascii.png", "xyz": [8.5, 64.0, -3.25], "yaw": 0.0, "pitch": 65.0}
    lines = []
    for name, target in (("a.png", SHOWN.target), ("b.png", None)):
        frame = paint(
            np.full((540, 960, 3), 60, np.uint8), dataclasses.replace(SHOWN, target=target), font_of(drawn_atlas())
        )
        cv2.imwrite(str(path / name), frame)
        said = {"pos": list(target.pos), "id": target.id} if target and target.pos else None
        lines.append({"file": name, **about, "target": said})
    lines[0] |= changes
    (path / TRUTH).write_text("".join(json.dumps(line) + "\n" for line in lines), "utf-8")
    return path


def test_pictures_that_match_their_truths_have_no_differences(tmp_path: Path) -> None:
    folder = folder_of(tmp_path)
    read = truths(folder)
    assert [truth["file"] for truth in read] == ["a.png", "b.png"]
    assert [line for truth in read for line in differences(folder, truth)] == []


@pytest.mark.parametrize(
    "change",
    [
        {"xyz": [8.5, 64.0, 3.25]},
        {"yaw": 1.0},
        {"pitch": -65.0},
        {"target": None},
        {"target": {"pos": [8, 63, -2], "id": "x"}},
    ],
)
def test_each_difference_from_the_truth_is_reported(change: dict[str, Any], tmp_path: Path) -> None:
    folder = folder_of(tmp_path, **change)
    (told,) = differences(folder, truths(folder)[0])
    assert told.startswith(f"a.png: {next(iter(change))} is ")


def test_a_folder_without_truths_or_with_an_incomplete_one_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"there is no .*truth\.jsonl"):
        truths(tmp_path)
    (tmp_path / TRUTH).write_text("\n", "utf-8")
    with pytest.raises(ValueError, match="has no line"):
        truths(tmp_path)
    (tmp_path / TRUTH).write_text('{"file": "a.png", "font": "x", "xyz": null, "yaw": 1}\n', "utf-8")
    with pytest.raises(ValueError, match="line 1: lacks pitch, target"):
        truths(tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize(("change", "outcome"), [({}, "2 passed"), ({"yaw": 1.0}, "1 failed, 1 passed")])
def test_the_folder_that_the_environment_names_is_read(change: dict[str, Any], outcome: str, tmp_path: Path) -> None:
    folder = folder_of(tmp_path, **change)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "-n",
        "0",
        "-k",
        "of_the_real_game",
        __file__,
    ]
    environment = {**os.environ, VARIABLE: str(folder), "PYTHONPATH": str(ROOT)}
    ran = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=120)
    assert outcome in ran.stdout
