"""``mc-nested calibrate font``: what it prints and writes, and one line for a mistake."""

from pathlib import Path

import pytest

from mc_nested.cli import calibrating
from mc_nested.live.profile.store import load_profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_of, font_file_in, started
from tests.cli.running import run


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """The game on this desktop."""
    client = started(VirtualClient(pitch=65.0))
    monkeypatch.setattr(calibrating, "context_opener", lambda _say, ask, **_: context_of(client, ask))
    return client


def test_what_was_found_is_printed_and_the_font_is_written_into_a_new_profile(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, font = tmp_path / "mine.toml", font_file_in(tmp_path)
    assert run("calibrate", "font", "--profile", file, "--font", font) == 0
    printed = capsys.readouterr().out.splitlines()
    scale = f"GUI scale {client.scale}, text (224, 224, 224), a line every 9 dots, dots from the corner on"
    assert scale in printed
    picture = tmp_path / "mine-font.png"
    assert printed[-1] == f"compare what is seen with what is read: {picture}"
    assert picture.is_file()
    assert load_profile(file).screen.font == str(font)


@pytest.mark.parametrize(
    ("font", "message"),
    [("nowhere.jar", "there is no nowhere.jar"), ("notes.png", "notes.png")],
    ids=["no file", "no font"],
)
def test_a_font_that_can_not_be_used_is_one_line_and_nothing_is_written(
    font: str,
    message: str,
    client: VirtualClient,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "notes.png").write_text("no picture", "utf-8")
    assert run("calibrate", "font", "--profile", "new.toml", "--font", font) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["notes.png"]
    assert client.window.strays == []
