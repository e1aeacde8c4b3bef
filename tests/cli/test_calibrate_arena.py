"""``calibrate arena``: what it prints and writes, and that it refuses a game that others may share."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from calibration.context import OpenContext
from mc_nested.cli import calibrating
from mc_nested.cli.app import main
from mc_nested.live.profile.store import load_profile, save_profile
from sim.client.client import VirtualClient
from tests.calibration.virtual_context import context_on, profile_of


@pytest.fixture
def client(monkeypatch: pytest.MonkeyPatch) -> VirtualClient:
    """The game on this desktop, shared with others."""
    client = VirtualClient()
    monkeypatch.setattr(client.display, "title", lambda: "Minecraft 1.20.1 - Multiplayer (LAN)")
    monkeypatch.setattr(calibrating, "context_opener", partial(context_of, client))
    return client


def context_of(
    client: VirtualClient,
    say: Callable[[str], None],
    _ask: Callable[[str], bool],
    *,
    is_server_allowed: bool,
    **_: object,
) -> OpenContext:
    return context_on(client, say, is_server_allowed=is_server_allowed)


def code_of(*words: str | Path) -> int | str | None:
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code


def test_it_is_refused(client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    assert code_of("calibrate", "arena", "--profile", file) == 2
    assert capsys.readouterr().err.endswith("or allow it with --server-allowed\n")
    assert client.built == {}
    assert client.realm.player.feet == (0.5, 64.0, 0.5)


def test_an_arena_is_built_and_undone_where_that_is_allowed_and_each_says_which_file_was_written(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    assert code_of("calibrate", "arena", "--yes", "--server-allowed", "--profile", file) in (0, None)
    assert load_profile(file).arena is not None
    assert capsys.readouterr().out.splitlines()[-1] == f"written to {file}"
    assert code_of("calibrate", "arena", "--undo", "--server-allowed", "--profile", file) in (0, None)
    assert client.built == {}
    assert capsys.readouterr().out.splitlines()[-1] == f"written to {file}"


def test_the_arena_is_as_large_as_was_asked_for_and_a_size_that_none_has_is_one_line(
    client: VirtualClient, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "mine.toml"
    save_profile(profile_of(client, tmp_path), file)
    before = file.read_bytes()
    assert code_of("calibrate", "arena", "--yes", "--server-allowed", "--profile", file, "--size", "33") == 2
    assert capsys.readouterr().err == (
        "mc-nested: an arena of 33 x 33 cells: choose 15 to 32 cells along each side; a smaller scenario is played in "
        "a part of it\n"
    )
    assert (file.read_bytes(), client.built) == (before, {})
    assert code_of("calibrate", "arena", "--yes", "--server-allowed", "--profile", file, "--size", "20") in (0, None)
    assert load_profile(file).marked_arena().size == 20


def test_marking_and_undoing_at_once_is_one_line_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert code_of("calibrate", "arena", "--mark-only", "--undo", "--profile", tmp_path / "new.toml") == 2
    error = "mc-nested: --mark-only and --undo do different things: choose one of them\n"
    assert capsys.readouterr().err == error
    assert list(tmp_path.iterdir()) == []
