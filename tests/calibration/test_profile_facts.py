"""What a list says of a profile, and whether it fits the window that is open."""

from pathlib import Path

import pytest

from calibration.profile_facts import ProfileFacts, facts_of
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable

ARENA = Arena.around((5, 64, -20), "west", size=20)
CALIBRATED = CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)


def facts(tmp_path: Path, profile: Profile, window: Fingerprint | None = None) -> ProfileFacts:
    save_profile(profile, tmp_path / "laptop.toml")
    return facts_of(tmp_path / "laptop.toml", lambda title: window if title == profile.window.title else None)


def test_it_says_what_it_was_calibrated_on_and_that_it_fits_that(tmp_path: Path) -> None:
    profile = Profile(arena=ARENA, calibrated=CALIBRATED)
    assert facts(tmp_path, profile, Fingerprint("Minecraft 1.20.1", (854, 480))) == ProfileFacts(
        name="laptop",
        file=tmp_path / "laptop.toml",
        fits=True,
        version="1.20.1",
        window=(854, 480),
        gui_scale=2,
        debug_scale=2,
        arena_size=20,
        date="2026-11-21",
    )


@pytest.mark.parametrize(
    ("window", "fits", "why"),
    [
        (Fingerprint("Minecraft 1.21", (854, 480)), False, "was calibrated on Minecraft 1.20.1, and this is 1.21"),
        (Fingerprint("Minecraft 1.20.1", (1000, 480)), False, "and this one has 1000 x 480"),
        (None, None, "no window of the game is open"),
    ],
)
def test_what_does_not_fit_or_is_not_known_is_said(
    window: Fingerprint | None, fits: bool | None, why: str, tmp_path: Path
) -> None:
    found = facts(tmp_path, Profile(calibrated=CALIBRATED), window)
    assert found.fits is fits
    assert why in (found.why or "")


def test_one_that_was_marked_by_hand_fits_nothing_known(tmp_path: Path) -> None:
    found = facts(tmp_path, Profile(arena=ARENA), Fingerprint("Minecraft 1.20.1", (854, 480)))
    assert found.fits is None
    assert found.why == "it was never calibrated as a whole: mc-nested calibrate all --profile laptop"
    assert (found.version, found.window, found.date) == ("1.21", None, None)


def test_a_font_that_is_gone_is_said_without_any_window(tmp_path: Path) -> None:
    jar = tmp_path / "1.20.1.jar"
    profile = Profile(screen=ScreenTable(font=str(jar)), calibrated=CALIBRATED)
    found = facts(tmp_path, profile)
    assert found.fits is False
    assert f"its font {jar} is gone: mc-nested calibrate font --profile laptop" in (found.why or "")
    jar.touch()
    assert facts(tmp_path, profile).fits is None


def test_a_damaged_one_says_why_in_a_line(tmp_path: Path) -> None:
    (tmp_path / "torn.toml").write_text("[keys]\nforward = 3\n")
    found = facts_of(tmp_path / "torn.toml", lambda _: None)
    assert found.is_damaged
    assert (found.why or "").startswith(f"{tmp_path / 'torn.toml'}: keys.forward: ")
    assert "\n" not in (found.why or "")
