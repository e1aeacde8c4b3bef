"""Drives load_font and Font with atlases of the drawn font, whole and damaged; reading frames is left to others."""

import io
import subprocess
import sys
import zipfile
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mc_nested.errors import FontError
from mc_nested.live.vision.font import ENTRY, Font, font_of, load_font
from sim.client.drawing.letters import drawn_atlas
from tests.live.huge_picture import png_of_nothing

LETTERS = [chr(code) for code in range(ord("!"), ord("~") + 1)]


def png(picture: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    return cv2.imencode(".png", picture)[1].tobytes()


def jar(content: dict[str, bytes]) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, data in content.items():
            archive.writestr(name, data)
    return stream.getvalue()


def cell(atlas: NDArray[np.uint8], char: str) -> NDArray[np.uint8]:
    top, left = (8 * index for index in divmod(ord(char), 16))
    return atlas[top : top + 8, left : left + 8]


def test_a_picture_a_jar_and_a_folder_give_the_same_font(tmp_path: Path) -> None:
    picture = png(drawn_atlas())
    (tmp_path / "ascii.png").write_bytes(picture)
    (tmp_path / "client.jar").write_bytes(jar({ENTRY: picture}))
    folder = tmp_path / "pack" / ENTRY
    folder.parent.mkdir(parents=True)
    folder.write_bytes(picture)
    fonts = [load_font(tmp_path / name) for name in ("ascii.png", "client.jar", "pack")]
    assert all(font == font_of(drawn_atlas()) for font in fonts)


@pytest.mark.parametrize("times", [2, 4])
def test_a_finer_picture_of_the_same_dots_gives_the_same_font(times: int) -> None:
    assert font_of(drawn_atlas().repeat(times, 0).repeat(times, 1)) == font_of(drawn_atlas())


def test_a_picture_of_sixteen_bits_gives_the_same_font(tmp_path: Path) -> None:
    (tmp_path / "deep.png").write_bytes(png(drawn_atlas().astype(np.uint16) * 257))
    assert load_font(tmp_path / "deep.png") == font_of(drawn_atlas())


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="Linux says how much memory a process has taken")
def test_a_picture_of_a_billion_pixels_is_refused_by_its_stated_size(tmp_path: Path) -> None:
    (tmp_path / "huge.png").write_bytes(png_of_nothing(30_000, 30_000))
    measure = (
        "import pathlib, re, sys, time\n"
        "from mc_nested.errors import FontError\n"
        "from mc_nested.live.vision.font import load_font\n"
        "began = time.process_time()\n"
        "try:\n"
        "    load_font(pathlib.Path(sys.argv[1]))\n"
        "except FontError as error:\n"
        "    status = pathlib.Path('/proc/self/status').read_text()\n"
        "    print(time.process_time() - began, re.search(r'VmHWM:\\s+(\\d+) kB', status)[1], error)\n"
    )
    words = [sys.executable, "-c", measure, str(tmp_path / "huge.png")]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    seconds, kilobytes, says = done.stdout.split(" ", 2)
    assert "huge.png has more pixels than any screen: give the game's jar" in says
    assert float(seconds) < 1
    assert int(kilobytes) < 200_000
    assert done.stderr == ""


def test_a_glyph_advances_the_pen_by_its_width_and_a_gap_and_a_space_by_four() -> None:
    atlas = np.zeros((128, 128, 4), np.uint8)
    atlas[...] = drawn_atlas()
    cell(atlas, "w")[..., 3] = 0
    cell(atlas, "w")[2, 1:4, 3] = 255
    font = font_of(atlas)
    assert font.columns("w w") == b"\0\4\4\4\0" + b"\0" * 4 + b"\0\4\4\4\0"


def test_letters_with_the_same_glyph_are_left_out_of_the_lookup() -> None:
    atlas = drawn_atlas()
    cell(atlas, "I")[...] = cell(atlas, "l")
    known = {char for char, *_ in font_of(atlas).lookup.values()}
    assert "I" not in known
    assert "l" not in known


def test_quotation_marks_are_left_out_of_the_lookup_as_one_may_be_two_apostrophes() -> None:
    known = {char for char, *_ in font_of(drawn_atlas()).lookup.values()}
    assert known == set(LETTERS) - {'"', "'"}


def spoilt(name: str) -> bytes:
    atlas = drawn_atlas()
    if name == "wrong size":
        return png(atlas[:100])
    if name == "no transparency":
        return png(np.ascontiguousarray(atlas[..., :3]))
    if name == "finer glyphs":
        atlas = atlas.repeat(2, 0).repeat(2, 1)
        atlas[49, 17, 3] ^= 255
    if name == "empty":
        atlas[..., 3] = 0
    if name == "eight like three":
        cell(atlas, "8")[...] = cell(atlas, "3")
    if name == "a jar without the font":
        return jar({"pack.mcmeta": b"{}"})
    if name == "a jar with another picture":
        return jar({ENTRY: b"no picture"})
    return {"nothing": b"", "text": b"no picture", "half a jar": jar({ENTRY: png(atlas)})[:-80]}.get(name, png(atlas))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("wrong size", "128 x 100"),
        ("no transparency", "no transparency"),
        ("finer glyphs", "take that pack off in the game's options"),
        ("empty", "no glyph for 0123456789"),
        ("eight like three", "38"),
        ("a jar without the font", ENTRY),
        ("a jar with another picture", "not a picture"),
        ("nothing", "not a picture"),
        ("text", "not a picture"),
        ("half a jar", "not a picture"),
    ],
)
def test_an_unusable_font_file_is_a_one_line_error(tmp_path: Path, name: str, words: str) -> None:
    (tmp_path / "given").write_bytes(spoilt(name))
    with pytest.raises(FontError, match=words) as caught:
        load_font(tmp_path / "given")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["missing.png", "empty folder"])
def test_a_missing_font_file_is_reported(tmp_path: Path, name: str) -> None:
    (tmp_path / "empty folder").mkdir()
    with pytest.raises(FontError, match="there is no"):
        load_font(tmp_path / name)


def test_laying_out_a_letter_that_the_font_lacks_is_an_error() -> None:
    with pytest.raises(FontError, match="é"):
        font_of(drawn_atlas()).columns("é")


@given(st.binary(max_size=400))
def test_a_file_of_random_bytes_is_a_font_error(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    path = tmp_path_factory.mktemp("any") / "given"
    path.write_bytes(data)
    with pytest.raises(FontError):
        load_font(path)


def test_fonts_with_the_same_glyphs_are_equal() -> None:
    assert Font({"a": b"\1"}) == Font({"a": b"\1"})
