"""``calibrate arena`` and ``calibrate walk`` in a game that others may share: one line, and nothing is pressed."""

from pathlib import Path

import pytest

from mc_nested.cli import calibrate_arena, calibrate_walk
from mc_nested.cli.app import main
from mc_nested.live.profile import load_profile, save_profile
from sim.client.client import VirtualClient
from tests.calibration.virtual_bench import bench_on, profile_of


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """The game on this desktop, shared with others."""
    client = VirtualClient()
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")
    for verb in (calibrate_arena, calibrate_walk):
        monkeypatch.setattr(verb, "bench_for", lambda say, _ask: bench_on(client, say))
    return client


def code_of(*words: str | Path) -> int | str | None:
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code


@pytest.mark.parametrize("verb", ["arena", "walk"])
def test_it_is_refused(verb: str, client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    assert code_of("calibrate", verb, "--profile", file) == 2
    assert capsys.readouterr().err.endswith("or allow it with --server-allowed\n")
    assert client.built == {}
    assert client.realm.player.feet == (0.5, 64.0, 0.5)


def test_an_arena_is_built_and_undone_there_where_that_is_allowed(client: VirtualClient, tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    assert code_of("calibrate", "arena", "--yes", "--server-allowed", "--profile", file) in (0, None)
    assert load_profile(file).arena is not None
    assert code_of("calibrate", "arena", "--undo", "--server-allowed", "--profile", file) in (0, None)
    assert client.built == {}
