"""A calibration that is stopped or disturbed midway: one line, every key up, and the old profile to the byte."""

from collections.abc import Callable
from pathlib import Path

import pytest

from calibration.clicks.find import calibrate_clicks
from calibration.context import OpenContext
from calibration.font.find import calibrate_font
from calibration.font.sources import FontSources
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotInFrontError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.menus import recovery
from mc_nested.live.profile.store import load_profile, save_profile
from sim.client.client import VirtualClient
from sim.client.game.options import GameOptions
from sim.client.mishaps import Kind
from tests.calibration.contexts import context_of, profile_in, started

Step = Callable[[Path, OpenContext], object]


def font_step(file: Path, opened: OpenContext) -> object:
    return calibrate_font(file, opened, sources=lambda _: FontSources((file.parent / "ascii.png",)))


STEPS: dict[str, Step] = {"font": font_step, "clicks": calibrate_clicks}
LENGTHS = {"font": 2.3, "clicks": 6.5}
"""Seconds of game time that each takes when nothing happens; the font's with the debug screen off at first."""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Return an old profile with a comment in it."""
    path = tmp_path / "mine.toml"
    save_profile(profile_in(tmp_path), path)
    path.write_text("# by hand\n" + path.read_text("utf-8"), "utf-8")
    return path


def moments(step: str, count: int) -> list[float]:
    return [(index + 0.5) * LENGTHS[step] / count for index in range(count)]


CASES = [(step, after_s) for step in STEPS for after_s in moments(step, 7)]


def check_nothing_left(client: VirtualClient, file: Path, before: bytes) -> None:
    assert (client.window.down, client.window.strays) == (set(), [])
    assert client.clipboard.read() == "mine"
    assert file.read_bytes() == before
    assert sorted(each.name for each in file.parent.iterdir()) == ["ascii.png", "mine.toml"]


def client_for(step: str, seed: int = 0, *, pauses_unfocused: bool = True) -> VirtualClient:
    client = started(
        VirtualClient(has_f3=step != "font", seed=seed, options=GameOptions(pause_on_lost_focus=pauses_unfocused))
    )
    client.clipboard.write("mine")
    return client


@pytest.mark.parametrize(("step", "after_s"), CASES)
def test_ctrl_c_at_any_stage_leaves_everything_as_it_was(step: str, after_s: float, file: Path) -> None:
    client, before = client_for(step), file.read_bytes()

    def interrupt() -> None:
        raise KeyboardInterrupt

    client.clock.call_at(client.clock.now() + after_s, interrupt)
    with pytest.raises(KeyboardInterrupt):
        STEPS[step](file, context_of(client))
    check_nothing_left(client, file, before)


@pytest.mark.parametrize(("step", "after_s"), CASES[::2])
def test_a_program_that_stays_in_front_ends_the_step_and_leaves_everything_as_it_was(
    step: str, after_s: float, file: Path
) -> None:
    client, before = client_for(step, pauses_unfocused=False), file.read_bytes()
    client.clock.call_at(client.clock.now() + after_s, lambda: client.set_front(is_in_front=False))
    with pytest.raises(NotInFrontError) as raised:
        STEPS[step](file, context_of(client))
    assert "\n" not in str(raised.value)
    check_nothing_left(client, file, before)


@pytest.mark.parametrize(("step", "after_s"), CASES[::2])
def test_a_window_that_closes_ends_the_step_and_leaves_everything_as_it_was(
    step: str, after_s: float, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    client, before = client_for(step), file.read_bytes()
    closes_at, grab = client.clock.now() + after_s, client.display.grab

    def grabbed(region: Region | None = None) -> Frame:
        if client.clock.now() >= closes_at:
            raise DesktopError("the window 'Minecraft 1.20.1' has closed: start the game again")
        return grab(region)

    monkeypatch.setattr(client.display, "grab", grabbed)
    with pytest.raises(DesktopError, match="has closed"):
        STEPS[step](file, context_of(client))
    check_nothing_left(client, file, before)


@pytest.mark.parametrize("after_s", moments("clicks", 5))
def test_a_window_that_is_resized_ends_the_step_and_leaves_everything_as_it_was(after_s: float, file: Path) -> None:
    client, before = client_for("clicks"), file.read_bytes()
    client.clock.call_at(client.clock.now() + after_s, lambda: client.resize((1024, 768)))
    with pytest.raises(LiveError, match="changed its size"):
        calibrate_clicks(file, context_of(client))
    check_nothing_left(client, file, before)


@pytest.mark.parametrize("after_s", moments("clicks", 3))
def test_a_window_that_stays_black_ends_the_step_and_leaves_everything_as_it_was(
    after_s: float, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recovery, "PATIENCE_S", 8.0)
    client, before = client_for("clicks"), file.read_bytes()
    client.clock.call_at(client.clock.now() + after_s, lambda: client.blacken(1000.0))
    began = client.clock.now()
    with pytest.raises(LiveError) as raised:
        calibrate_clicks(file, context_of(client))
    assert "\n" not in str(raised.value)
    assert client.clock.now() - began < 100
    check_nothing_left(client, file, before)


KINDS: tuple[Kind, ...] = (
    *("lost_focus", "chat", "inventory", "frozen_frame", "black_frame", "lag", "dropped_key", "late_key"),
    *("f3_off", "moved_window", "knocked_away", "death", "disconnect"),
)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("step", STEPS)
def test_mishap_ends_in_a_good_profile_or_in_a_one_line_error_and_the_old_profile(
    step: str, kind: Kind, file: Path
) -> None:
    client, before = client_for(step, seed=3), file.read_bytes()
    client.mishaps.plan(kind, LENGTHS[step] / 3)
    try:
        STEPS[step](file, context_of(client))
    except McNestedError as error:
        problem = str(error)
    else:
        problem = ""
    if problem:
        assert "\n" not in problem
        check_nothing_left(client, file, before)
    else:
        assert (client.window.down, client.window.strays) == (set(), [])
        assert client.clipboard.read() == "mine"
        profile = load_profile(file)
        assert profile.screen.font
        assert len(profile.points) in ({5} if step == "clicks" else {0})
        assert file.read_text("utf-8").startswith("# by hand\n")
