"""A film as a file: how long each picture is shown, what is refused, and what is left when something goes wrong."""

import errno
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from mc_nested.errors import FilmError, LiveError, with_extra
from mc_nested.report.film import LAST_S, check_film, open_film
from tests.full_disk import full_disk
from tests.report.films import BLUE, GREEN, RED, flat, pictures_of, shown


class Usage(NamedTuple):
    free: int


KINDS = pytest.mark.parametrize("kind", [".mp4", ".gif"])


@KINDS
def test_every_picture_is_shown_until_the_next_one_and_the_last_one_a_while(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"
    with open_film(path) as film:
        film.show(RED, 0.0)
        film.show(GREEN, 1.0)
        film.show(BLUE, 1.5)
        assert not path.exists()
    assert shown(path) == [("r", 1.0), ("g", 0.5), ("b", LAST_S)]
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


@KINDS
def test_times_between_two_frames_do_not_make_a_film_drift(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"
    with open_film(path) as film:
        for number in range(31):
            film.show((RED, GREEN, BLUE)[number % 3], number * 0.137)
    assert sum(seconds for _, seconds in shown(path)) == pytest.approx(30 * 0.137 + LAST_S, abs=0.051)


@KINDS
def test_a_film_that_begins_anew_shows_no_earlier_pictures(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"
    with open_film(path) as film:
        film.show(RED, 0.0)
        film.show(RED, 7.0)
        film.begin_anew()
        assert film.is_empty
        film.show(GREEN, 0.0)
    assert shown(path) == [("g", LAST_S)]


@KINDS
@pytest.mark.parametrize("error", [LiveError("it lagged"), KeyboardInterrupt(), OSError("another file"), SystemExit(3)])
def test_a_film_ended_by_an_error_is_complete(kind: str, error: BaseException, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"

    def play() -> None:
        with open_film(path) as film:
            film.show(RED, 0.0)
            film.show(GREEN, 1.0)
            raise error

    with pytest.raises(type(error)) as caught:
        play()
    assert caught.value is error
    assert shown(path) == [("r", 1.0), ("g", LAST_S)]


@KINDS
@pytest.mark.parametrize("error", [LiveError("it lagged"), OSError("another file")])
def test_a_film_without_pictures_leaves_an_earlier_film_in_place(kind: str, error: Exception, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"
    path.write_bytes(b"an earlier film")
    with pytest.raises(type(error)) as caught, open_film(path):
        raise error
    assert caught.value is error
    with open_film(path):
        pass
    assert path.read_bytes() == b"an earlier film"
    assert len(list(tmp_path.iterdir())) == 1


@KINDS
def test_pictures_of_odd_sizes_can_be_filmed(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"film{kind}"
    with open_film(path) as film:
        film.show(flat((200, 20, 20), 33, 25), 0.0)
    picture, _ = pictures_of(path)[0]
    assert picture.shape == ((26, 34, 3) if kind == ".mp4" else (25, 33, 3))
    assert shown(path) == [("r", LAST_S)]


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("film.avi", "a film is a file .mp4 or .gif"),
        ("film", "a film is a file .mp4 or .gif"),
        ("none/film.mp4", "none is no folder: name a film in a folder that exists"),
        ("folder.gif", "folder.gif is a folder: name another film"),
        ("file/film.gif", "file is no folder"),
    ],
)
def test_a_path_that_can_not_become_a_film_is_refused_and_nothing_is_written(
    name: str, says: str, tmp_path: Path
) -> None:
    (tmp_path / "folder.gif").mkdir()
    (tmp_path / "file").touch()
    with pytest.raises(FilmError, match=says):
        check_film(tmp_path / name)
    assert len(list(tmp_path.iterdir())) == 2


def test_a_format_in_capitals_is_accepted(tmp_path: Path) -> None:
    check_film(tmp_path / "FILM.MP4")
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_is_nearly_full_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shutil.disk_usage", lambda _: Usage(free=9_999_999))
    with pytest.raises(FilmError, match="less than 10 MB are free there: make room, or name another folder"):
        check_film(tmp_path / "film.gif")


def test_a_folder_that_nobody_may_write_to_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(**_: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr("tempfile.TemporaryFile", refused)
    with pytest.raises(FilmError, match=r"can't be written \(Permission denied\)"):
        check_film(tmp_path / "film.gif")


def test_a_missing_imageio_ffmpeg_refuses_an_mp4_with_the_install_command_but_no_gif(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(FilmError) as caught:
        check_film(tmp_path / "film.mp4")
    assert str(caught.value) == f"an .mp4 film needs imageio-ffmpeg, a .gif doesn't: {with_extra('video')}"
    check_film(tmp_path / "film.gif")


@pytest.mark.parametrize(
    ("kind", "fail"),
    [
        (".gif", lambda patch: patch.setattr("PIL.Image.Image.save", full_disk)),
        (".gif", lambda patch: patch.setattr("os.fsync", full_disk)),
        (".mp4", lambda patch: patch.setattr("os.fsync", full_disk)),
    ],
)
def test_a_disk_that_fills_up_is_reported_and_leaves_the_earlier_film(
    kind: str, fail: Callable[[pytest.MonkeyPatch], None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / f"film{kind}"
    path.write_bytes(b"an earlier film")
    fail(monkeypatch)
    with pytest.raises(FilmError) as caught, open_film(path) as film:
        film.show(RED, 0.0)
    assert str(caught.value) == (
        f"{path}: can't be written (no space left on the disk): make room, or name another folder"
    )
    assert path.read_bytes() == b"an earlier film"
    assert len(list(tmp_path.iterdir())) == 1
