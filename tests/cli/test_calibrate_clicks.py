"""``calibrate font`` and ``calibrate clicks`` on the command line: what they print, and one line for a mistake."""

from pathlib import Path

import pytest

from mc_nested.cli import calibrating
from mc_nested.cli.app import main
from mc_nested.live.profile.store import load_profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_of, font_file_in, started


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """The game on this desktop."""
    client = started(VirtualClient())
    monkeypatch.setattr(calibrating, "context_opener", lambda _say, ask, **_: context_of(client, ask))
    return client


def code_of(*words: str | Path) -> int | str | None:
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code


def test_from_a_bare_profile_to_points_that_are_shown(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    assert code_of("calibrate", "font", "--profile", file, "--font", font_file_in(tmp_path)) in (0, None)
    assert str(tmp_path / "mine-font.png") in capsys.readouterr().out
    assert code_of("calibrate", "clicks", "--profile", file, "--yes") in (0, None)
    assert str(tmp_path / "mine-clicks.png") in capsys.readouterr().out
    assert len(load_profile(file).points) == 5
    client.game.open("pause")
    assert code_of("calibrate", "clicks", "--profile", file, "--show") in (0, None)
    assert (tmp_path / "mine-clicks-now.png").is_file()
    assert code_of("calibrate", "clicks", "--profile", file, "--dry-run") in (0, None)
    assert "back_to_game: here, and the mouse over it" in capsys.readouterr().out
    assert client.game.screen == "pause"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("clicks",), "run mc-nested calibrate font first"),
        (("arena", "--mark-only", "--undo"), "choose one of them"),
        (("clicks", "--show", "--dry-run"), "choose one of them"),
        (("clicks", "--show"), "has no points with pictures"),
        (("clicks", "--hotkey", "f9"), "can't both record and skip"),
    ],
)
def test_a_mistake_is_one_line_and_nothing_is_written(
    words: tuple[str, ...],
    message: str,
    client: VirtualClient,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert code_of("calibrate", *words, "--profile", tmp_path / "new.toml") == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
    assert client.window.strays == []
