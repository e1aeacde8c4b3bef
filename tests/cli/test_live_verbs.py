"""What the verbs do when a live game, or somebody at it, ends them: one line, the right code, and nothing lost.

The live game is the simulator's behind the live path's door; what it does to a window is left to tests/live.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.game import Outcome, Resumable
from mc_nested.arena.rules import Action
from mc_nested.arena.scenario import Scenario
from mc_nested.cli import options, scenarios
from mc_nested.cli.app import main
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotInFrontError, StoppedError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.input.signals import EndedBySignal
from sim.grid import GridGame


class FragileGame(GridGame):
    """A live game that fails at its action number ``lasts``, and ever after, or only ``failures`` times."""

    def __init__(self, scenario: Scenario, lasts: float, error: McNestedError, failures: float) -> None:
        super().__init__(scenario)
        self._left = lasts
        self._error = error
        self._failures = failures

    @property
    def resumable(self) -> Resumable | None:
        return None

    def act(self, action: Action) -> Outcome:
        self._left -= 1
        if self._left < 0 < self._failures:
            self._failures -= 1
            raise self._error
        return super().act(action)


class GreyDisplay:
    """A window that is grey all over."""

    def size(self) -> tuple[int, int]:
        return 4, 3

    def title(self) -> str:
        return "Minecraft 1.20.1"

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        assert region is None
        return np.full((3, 4, 3), 99, np.uint8)


def open_live(
    monkeypatch: pytest.MonkeyPatch, lasts: float, error: McNestedError | None = None, failures: float = float("inf")
) -> None:
    """From here on a live game is one that lasts so many actions."""

    @contextmanager
    def opened(
        scenario: Scenario, profile: str, _say: object, **live: object
    ) -> Iterator[tuple[FragileGame, GreyDisplay]]:
        assert profile == "mine"
        assert live["is_server_allowed"] is False
        yield FragileGame(scenario, lasts, error or LiveError("never raised"), failures), GreyDisplay()

    monkeypatch.setattr(options, "open_live_game", opened)


def code_of(*words: str | Path) -> int | str | None:
    """The exit code of the command."""
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    return ended.value.code


@pytest.mark.parametrize("error", [LiveError("it lagged"), DesktopError("the window has closed")])
def test_a_training_whose_game_fails_is_saved_and_goes_on(
    error: McNestedError, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 30, error)
    live = ("--backend", "live", "--profile", "mine", "--episodes", "2")
    assert code_of("train", *live, "--out", tmp_path / "run") == 2
    told = capsys.readouterr().err.splitlines()
    assert told[-1] == f"mc-nested: {error}; saved: go on with mc-nested train --resume {tmp_path / 'run'}"
    open_live(monkeypatch, float("inf"))
    assert code_of("train", "--resume", tmp_path / "run") in (0, None)


def test_a_training_bears_an_episode_that_a_mishap_spoils(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    open_live(monkeypatch, 30, LiveError("it lagged"), failures=3)
    live = ("--backend", "live", "--profile", "mine", "--episodes", "3")
    assert code_of("train", *live, "--out", tmp_path / "run") in (0, None)
    rows = (tmp_path / "run" / "episodes.csv").read_text(encoding="utf-8").splitlines()
    assert [row.split(",")[1] for row in rows[1:]] == ["1", "2", "3"]


@pytest.mark.parametrize(("ending", "code"), [(KeyboardInterrupt(), 130), (EndedBySignal(15), 143)])
def test_whoever_stops_a_verb_is_told_in_one_line(
    ending: BaseException, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stop() -> list[str]:
        raise ending

    monkeypatch.setattr(scenarios, "shipped_scenarios", stop)
    assert code_of("scenarios") == code
    assert capsys.readouterr().err == "mc-nested: stopped\n"


def test_the_pictures_of_an_episode_are_of_that_episode_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert code_of("train", "--episodes", "1", "--out", tmp_path / "run") in (0, None)
    pictures = tmp_path / "run" / "screenshots"
    pictures.mkdir()
    (pictures / "999.png").touch()
    open_live(monkeypatch, float("inf"))
    assert code_of("play", tmp_path / "run", "--backend", "live", "--profile", "mine", "--screenshots") in (0, None)
    steps = int(capsys.readouterr().out.split(" steps")[0].split()[-1])
    assert [path.name for path in sorted(pictures.iterdir())] == [f"{step:03d}.png" for step in range(1, steps + 1)]


@pytest.mark.parametrize(("failures", "code"), [(1, 0), (2, 0), (3, 2)])
def test_an_episode_that_is_watched_begins_anew_twice_where_mishaps_spoil_it(
    failures: int, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert code_of("train", "--episodes", "1", "--out", tmp_path / "run") in (0, None)
    open_live(monkeypatch, 5, LiveError("it lagged"), failures)
    capsys.readouterr()
    assert (code_of("play", tmp_path / "run", "--backend", "live", "--profile", "mine") or 0) == code
    told = capsys.readouterr().err.splitlines()
    assert told.count("  it lagged; the episode starts over") == min(failures, 2)
    assert ("mc-nested: it lagged" in told) is (code == 2)


@pytest.mark.parametrize("error", [StoppedError("stopped by f12"), NotInFrontError("another window")])
def test_an_episode_that_a_person_stops_does_not_begin_anew(
    error: LiveError, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert code_of("train", "--episodes", "1", "--out", tmp_path / "run") in (0, None)
    open_live(monkeypatch, 5, error, 1)
    capsys.readouterr()
    assert code_of("play", tmp_path / "run", "--backend", "live", "--profile", "mine") == 2
    assert capsys.readouterr().err == f"mc-nested: {error}\n"


def test_the_simulator_has_no_window_to_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert code_of("train", "--episodes", "1", "--out", tmp_path / "run") in (0, None)
    assert code_of("play", tmp_path / "run", "--screenshots") == 2
    assert "leave out --screenshots" in capsys.readouterr().err
