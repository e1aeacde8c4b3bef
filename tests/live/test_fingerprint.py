"""Profiles that no longer fit are refused with the step to repeat, before anything is pressed."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import ProfileError
from mc_nested.live.desktop import Desktop
from mc_nested.live.fingerprint import Seen, check_fit, misfit, version_in
from mc_nested.live.profile import Profile, save_profile
from mc_nested.live.profile_tables import Arena, Calibrated, Screen
from mc_nested.live.session import open_live_game
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas
from sim.client.settings import ClientSettings

CALIBRATED = Calibrated(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)
SEEN = Seen("Minecraft 1.20.1 - Singleplayer", (854, 480), 2)


@pytest.mark.parametrize(
    ("title", "version"),
    [
        ("Minecraft 1.12.2", "1.12.2"),
        ("Minecraft* 26.1 - Multiplayer (LAN)", "26.1"),
        ("Minecraft 1.21.11-rc1", "1.21.11"),
        ("Minecraft: All the Mods 9", None),
        ("Prismarine Web Client - Chromium", None),
    ],
)
def test_the_title_says_the_version(title: str, version: str | None) -> None:
    assert version_in(title) == version


def test_what_was_calibrated_on_fits() -> None:
    assert misfit(CALIBRATED, SEEN, "default") is None


@pytest.mark.parametrize(
    ("seen", "complaint"),
    [
        (
            Seen("Minecraft* 1.20.2", (854, 480), 2),
            (
                "profile laptop was calibrated on Minecraft 1.20.1, and this is 1.20.2: start that version, or run "
                "mc-nested calibrate all --profile laptop"
            ),
        ),
        (
            Seen("Minecraft 1.20.1", (1024, 768), 2),
            (
                "profile laptop was calibrated in a window of 854 x 480 pixels, and this one has 1024 x 768: make it "
                "that size again, or run mc-nested calibrate all --profile laptop"
            ),
        ),
        (
            Seen("Minecraft 1.20.1", (854, 480), 1),
            (
                "profile laptop was calibrated at GUI scale 2, and this is 1: set Video Settings > GUI Scale to 2, or "
                "run mc-nested calibrate all --profile laptop"
            ),
        ),
    ],
)
def test_whatever_has_changed_is_named_with_the_step_to_repeat(seen: Seen, complaint: str) -> None:
    assert misfit(CALIBRATED, seen, "laptop") == complaint


def test_what_nobody_knows_is_not_compared() -> None:
    assert misfit(Calibrated(date="2026-11-21"), SEEN, "default") is None
    assert misfit(CALIBRATED, Seen("All the Mods 9", (854, 480)), "default") is None


SIZES = st.tuples(st.integers(320, 4000), st.integers(240, 3000))


@given(SIZES, SIZES, st.integers(1, 4), st.integers(1, 4))
def test_a_profile_fits_exactly_where_size_and_scale_are_the_same(
    then: tuple[int, int], now: tuple[int, int], scale: int, scale_now: int
) -> None:
    calibrated = Calibrated(date="2026-11-21", version="1.20.1", window=then, gui_scale=scale)
    problem = misfit(calibrated, Seen("Minecraft 1.20.1", now, scale_now), "default")
    assert (problem is None) == (then == now and scale == scale_now)


def test_a_profile_that_was_never_calibrated_plays_as_before() -> None:
    check_fit(None, Seen("Minecraft 1.8.9", (640, 480), 1), "default")
    with pytest.raises(ProfileError, match="was calibrated on Minecraft"):
        check_fit(CALIBRATED, Seen("Minecraft 1.8.9", (640, 480), 1), "default")


def saved(folder: Path, calibrated: Calibrated) -> Path:
    font = folder / "ascii.png"
    font.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    arena = Arena.around((-20, 64, 31), "south")
    save_profile(
        Profile(screen=Screen(font=str(font)), arena=arena, calibrated=calibrated), path := folder / "mine.toml"
    )
    return path


@pytest.mark.parametrize(
    ("settings", "complaint"),
    [
        (ClientSettings(version="1.19.4"), "this is 1.19.4"),
        (ClientSettings(size=(1024, 768)), "this one has 1024 x 768"),
        (ClientSettings(scale=1), "this is 1: set Video Settings"),
    ],
)
def test_a_live_game_that_does_not_fit_is_not_opened_and_nothing_is_pressed(
    settings: ClientSettings, complaint: str, tmp_path: Path
) -> None:
    client = VirtualClient(settings)

    @contextmanager
    def opened(_title: str) -> Iterator[Desktop]:
        yield Desktop(client.display, client.keyboard, client.pointer, client.clock, client.clipboard)

    file = saved(tmp_path, CALIBRATED)
    with (
        pytest.raises(ProfileError, match=complaint) as caught,
        open_live_game(load_scenario("line"), str(file), lambda _: None, open_devices=opened),
    ):
        pass
    assert f"mc-nested calibrate all --profile {file}" in str(caught.value)
    assert not client.window.down
    assert not client.window.strays
    assert not client.built
