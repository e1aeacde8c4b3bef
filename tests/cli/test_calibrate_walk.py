"""``mc-nested calibrate walk``: what it prints and writes, and that it refuses a game that others may share."""

from collections.abc import Callable
from pathlib import Path

import pytest

from calibration.context import OpenContext, StepResult
from mc_nested.cli import calibrate_walk, calibrating
from mc_nested.live.profile.store import load_profile, save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.calibration.virtual_context import context_on, profile_of
from tests.cli.running import run


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """The game on this desktop."""
    client = VirtualClient(pitch=65.0)

    def opener(
        say: Callable[[str], None], _ask: Callable[[str], bool], *, is_server_allowed: bool, **_: object
    ) -> OpenContext:
        return context_on(client, say, is_server_allowed=is_server_allowed)

    monkeypatch.setattr(calibrating, "context_opener", opener)
    return client


def share(client: VirtualClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")


@pytest.mark.slow
def test_what_was_measured_is_printed_and_written(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    assert run("calibrate", "walk", "--profile", file) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("Measuring how you walk")
    assert [line for line in printed if line.startswith("Walking 4.3")]
    assert printed[-1] == f"written to {file}; look at the curve in {tmp_path / 'mine-walk.png'}"
    assert (tmp_path / "mine-walk.png").is_file()
    assert load_profile(file).walk.inertia == pytest.approx(0.546, abs=0.002)


def test_a_shared_game_is_refused_and_nothing_is_pressed(
    client: VirtualClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    share(client, monkeypatch)
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    before = file.read_bytes()
    assert run("calibrate", "walk", "--profile", file) == 2
    assert capsys.readouterr().err.endswith("or allow it with --server-allowed\n")
    assert client.built == {}
    assert client.realm.player.feet == (0.5, 64.0, 0.5)
    assert file.read_bytes() == before


def test_a_shared_game_is_walked_in_where_that_is_allowed(
    client: VirtualClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    share(client, monkeypatch)

    def measure(profile_name: str, context_of: OpenContext) -> tuple[StepResult, Path]:
        assert profile_name == "mine"
        with context_of(Profile()) as context:
            context.connection.check_single_player()
        return StepResult("walk", Profile(), ("one cell is 4 ticks", "sneaking is slower"), 1), tmp_path / "curve.png"

    monkeypatch.setattr(calibrate_walk, "calibrate_walk", measure)
    assert run("calibrate", "walk", "--server-allowed", "--profile", "mine") == 0
    assert capsys.readouterr().out.splitlines() == [
        "one cell is 4 ticks",
        "sneaking is slower",
        f"written to mine; look at the curve in {tmp_path / 'curve.png'}",
    ]
    assert run("calibrate", "walk", "--profile", "mine") == 2


def test_a_profile_without_a_font_is_one_line_and_nothing_is_written(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("calibrate", "walk", "--profile", tmp_path / "new.toml") == 2
    error = capsys.readouterr().err
    assert "run mc-nested calibrate font first" in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
    assert client.window.strays == []
