"""``mc-nested read``: one line a picture, for a person or as JSON, with a profile or without."""

import json
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import font_of
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.f3_screen import F3Screen
from tests.calibration.contexts import font_file_in
from tests.cli.running import run

STONE = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, 65.0, Target((8, 63, -2), "minecraft:stone"))
SKY = F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, -65.0)


def printed(capsys: pytest.CaptureFixture[str], *words: str | Path) -> list[str]:
    """Return what the command prints, line by line."""
    assert run("read", *words) == 0
    return capsys.readouterr().out.splitlines()


@pytest.fixture
def font(tmp_path: Path) -> Path:
    return font_file_in(tmp_path)


def picture(path: Path, screen: F3Screen) -> Path:
    cv2.imwrite(str(path), paint(np.full((480, 854, 3), 60, np.uint8), screen, font_of(drawn_atlas())))
    return path


def test_read_prints_one_line_a_picture_with_the_pose_and_the_looked_at_block(
    tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stone, sky = picture(tmp_path / "a.png", STONE), picture(tmp_path / "b.png", SKY)
    assert printed(capsys, stone, sky, "--font", font) == [
        f"{stone}: at 8.500 64.000 -3.250, yaw 0.0, pitch 65.0, looks at minecraft:stone [8, 63, -2]",
        f"{sky}: at 8.500 64.000 -3.250, yaw 0.0, pitch -65.0, looks at no block",
    ]


def test_read_explains_a_missing_block_with_a_debug_entry_that_may_be_off(
    tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ground = picture(tmp_path / "a.png", F3Screen("1.16-1.19.2", 2, (8.5, 64.0, -3.25), 0.0, 65.0))
    (line,) = printed(capsys, ground, "--font", font)
    assert line.endswith(
        "looks at no block: if the ground is in view, that line is off: from 1.21.9 on press F3+F6, and set "
        "looking_at_block (from 26.1 on looking_at_block_state) to In Overlay"
    )


def test_unreadable_picture_gets_a_line_with_the_reason(
    tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (line,) = printed(capsys, picture(tmp_path / "a.png", SKY), "--font", font)
    assert " looks at no block" in line
    cv2.imwrite(str(tmp_path / "grey.png"), np.full((480, 854, 3), 60, np.uint8))
    (line,) = printed(capsys, tmp_path / "grey.png", "--font", font)
    assert line.startswith(f"{tmp_path / 'grey.png'}: unread: no debug screen is to be seen")


@pytest.mark.parametrize("as_json", [True, False])
def test_file_that_is_not_a_picture_is_an_error_after_the_others_are_read(
    as_json: bool, tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "notes.txt").write_text("no picture", "utf-8")
    images = [tmp_path / "notes.txt", picture(tmp_path / "a.png", STONE), tmp_path / "none.png"]
    assert run("read", *images, "--font", font, *(["--json"] if as_json else [])) == 2
    said = capsys.readouterr()
    assert len(said.out.splitlines()) == 1
    assert said.err == (
        f"mc-nested: {tmp_path / 'notes.txt'} is not a picture, or is damaged: give a PNG of the game's window, as F2 "
        "takes it; 1 other file can't be read either\n"
    )


def test_as_json_each_picture_is_an_object(tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (line,) = printed(capsys, picture(tmp_path / "a.png", STONE), "--font", font, "--json")
    assert json.loads(line)["xyz"] == [8.5, 64.0, -3.25]


@pytest.mark.parametrize(("scale", "is_read"), [(2, True), (3, False)])
def test_read_takes_the_font_and_the_debug_scale_from_the_profile(
    scale: int, is_read: bool, tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    profile = tmp_path / "mine.toml"
    profile.write_text(f"[screen]\nfont = {json.dumps(str(font))}\ndebug_scale = {scale}\n", "utf-8")
    (line,) = printed(capsys, picture(tmp_path / "a.png", STONE), "--profile", profile)
    assert ("at 8.500" in line) is is_read
    assert ("GUI scale 3" in line) is not is_read


def test_font_option_comes_before_the_profiles_font(
    tmp_path: Path, font: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    profile = tmp_path / "mine.toml"
    profile.write_text("[screen]\nfont = '/nowhere/ascii.png'\n", "utf-8")
    (line,) = printed(capsys, picture(tmp_path / "a.png", STONE), "--profile", profile, "--font", font)
    assert "at 8.500" in line


@pytest.mark.parametrize("verb", [["read", "--font", "FONT"], ["build"], ["doctor", "read", "--font", "FONT"]])
def test_a_broken_picture_is_one_line_and_no_library_says_anything_of_its_own(
    verb: list[str], tmp_path: Path, font: Path
) -> None:
    small = cv2.imencode(".png", np.random.default_rng(0).integers(0, 256, (15, 15, 3), np.uint8))[1].tobytes()
    (tmp_path / "broken.png").write_bytes(small[:200] if verb == ["build"] else small[:200] + b"\0" + small[201:])
    words = [str(font) if word == "FONT" else word for word in verb]
    command = [sys.executable, "-c", "from mc_nested.cli import main; main()", *words, str(tmp_path / "broken.png")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith("mc-nested: ")
    assert done.stderr.count("\n") == 1, done.stderr
