"""Profiles that no longer fit are refused with the step to repeat, before anything is pressed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.profile.fingerprint import (
    Fingerprint,
    check_fit,
    check_single_player,
    game_in,
    mismatch,
)
from mc_nested.live.profile.tables import CalibratedTable, GameVersion
from mc_nested.live.vision.layout import Scales

CALIBRATED = CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)
CURRENT = Fingerprint("Minecraft 1.20.1 - Singleplayer", (854, 480), Scales(2, 2))


def test_an_unchanged_window_fits_its_profile() -> None:
    assert mismatch(CALIBRATED, CURRENT, "default") is None


@pytest.mark.parametrize(
    ("current", "complaint"),
    [
        (
            Fingerprint("Minecraft* 1.20.2", (854, 480), Scales(2, 2)),
            (
                "profile laptop was calibrated on Minecraft 1.20.1, and this is 1.20.2: start that version, or run "
                "mc-nested calibrate all --profile laptop"
            ),
        ),
        (
            Fingerprint("Minecraft 1.20.1", (1024, 768), Scales(2, 2)),
            (
                "profile laptop was calibrated in a window of 854 x 480 pixels, and this one has 1024 x 768: make it "
                "that size again, or run mc-nested calibrate all --profile laptop"
            ),
        ),
        (
            Fingerprint("Minecraft 1.20.1", (854, 480), Scales(1, 1)),
            (
                "profile laptop was calibrated at GUI scale 2, and this is 1: set Video Settings > GUI Scale to 2, or "
                "run mc-nested calibrate all --profile laptop"
            ),
        ),
    ],
)
def test_a_mismatch_names_the_change_and_the_step_to_repeat(current: Fingerprint, complaint: str) -> None:
    assert mismatch(CALIBRATED, current, "laptop") == complaint


def test_unknown_values_are_not_compared() -> None:
    assert mismatch(CalibratedTable(date="2026-11-21"), CURRENT, "default") is None
    assert mismatch(CALIBRATED, Fingerprint("All the Mods 9", (854, 480)), "default") is None


SIZES = st.tuples(st.integers(1280, 4000), st.integers(960, 3000))


@given(SIZES, SIZES, st.integers(1, 4), st.integers(1, 4))
def test_a_profile_fits_exactly_if_window_size_and_gui_scale_are_unchanged(
    then: tuple[int, int], now: tuple[int, int], scale: int, scale_now: int
) -> None:
    calibrated = CalibratedTable(date="2026-11-21", version="1.20.1", window=then, gui_scale=scale)
    problem = mismatch(calibrated, Fingerprint("Minecraft 1.20.1", now, Scales(scale_now, scale_now)), "default")
    assert (problem is None) == (then == now and scale == scale_now)


@pytest.mark.parametrize(("gui", "debug"), [(4, 4), (2, 3)])
def test_a_profile_with_scales_impossible_in_its_window_is_refused(gui: int, debug: int) -> None:
    calibrated = CalibratedTable(date="2026-11-21", window=(854, 480), gui_scale=gui, debug_scale=debug)
    problem = mismatch(calibrated, CURRENT, "mine")
    assert problem == (
        f"profile mine names GUI scale {Scales(gui, debug)}, which no window of 854 x 480 pixels can have: "
        "run mc-nested calibrate all --profile mine"
    )


def test_a_window_with_another_debug_scale_does_not_fit() -> None:
    problem = mismatch(CALIBRATED, Fingerprint("Minecraft 1.20.1", (854, 480), Scales(2, 1)), "mine")
    assert problem == (
        "profile mine was calibrated at GUI scale 2, and this is 2, debug screen 1: set Video Settings > GUI Scale to "
        "2, or run mc-nested calibrate all --profile mine"
    )


def test_a_profile_that_was_never_calibrated_fits_any_window() -> None:
    check_fit(None, Fingerprint("Minecraft 1.8.9", (640, 480), Scales(1, 1)), "default")
    with pytest.raises(ProfileError, match="was calibrated on Minecraft"):
        check_fit(CALIBRATED, Fingerprint("Minecraft 1.8.9", (640, 480), Scales(1, 1)), "default")


def test_the_version_comes_from_the_title_or_else_from_the_profile() -> None:
    known = GameVersion(version="1.16.5")
    assert game_in("Minecraft 1.20.1 - Singleplayer", known) == GameVersion(version="1.20.1")
    assert game_in("All the Mods 9", known) is known


@pytest.mark.parametrize(
    ("title", "is_server_allowed", "is_refused"),
    [
        ("Minecraft 1.20.1 - Multiplayer (LAN)", False, True),
        ("Minecraft 1.20.1 - Multiplayer (LAN)", True, False),
        ("Minecraft 1.20.1 - Singleplayer", False, False),
        ("Minecraft 1.20.1", False, False),
        ("Minecraft NeoForge* 1.21.1 - Multiplayer (3rd-party Server)", False, True),
        ("My pack - Multiplayer (LAN)", False, True),
        ("Minecraft* 1.20.1 - Einzelspieler", False, False),
    ],
)
def test_a_title_that_says_multiplayer_is_refused_unless_servers_are_allowed(
    title: str, is_server_allowed: bool, is_refused: bool
) -> None:
    if not is_refused:
        check_single_player(title, is_server_allowed=is_server_allowed)
        return
    with pytest.raises(DesktopError, match=r"others may be playing there: .*--server-allowed"):
        check_single_player(title, is_server_allowed=is_server_allowed)


@pytest.mark.parametrize("state", ["Mehrspieler (LAN)", "Многопользовательская игра (LAN)", "Jeu en solitaire"])
def test_a_title_with_an_unknown_state_is_refused_with_the_remedy(state: str) -> None:
    with pytest.raises(DesktopError, match=r"isn't known: set the game's language to English .*--server-allowed"):
        check_single_player(f"Minecraft 1.20.1 - {state}", is_server_allowed=False)
    check_single_player(f"Minecraft 1.20.1 - {state}", is_server_allowed=True)
