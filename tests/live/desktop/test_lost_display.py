"""A desktop that goes away under the game."""

import sys

import pytest

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.lost_display import LOST, raise_when_display_lost


def test_a_display_that_closes_under_the_game_is_an_error() -> None:
    assert LOST or not sys.platform.startswith("linux")
    for error in LOST:
        with pytest.raises(DesktopError, match="display has closed"), raise_when_display_lost():
            raise error("broken pipe")


def test_errors_of_other_causes_are_raised_unchanged() -> None:
    with pytest.raises(ValueError, match="other"), raise_when_display_lost():
        raise ValueError("other")
