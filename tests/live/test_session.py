"""Opening a live game: how the profile says the debug screen is drawn. The rest is played in a real window."""

import pytest

from mc_nested.live.debug_screen import Overlay
from mc_nested.live.profile import parse_profile
from mc_nested.live.session import overlay_of


@pytest.mark.parametrize(
    ("screen", "overlay"),
    [
        ("", None),
        ("line_pitch = 10\ntext_colour = [255, 255, 255]", None),
        ("gui_scale = 6", Overlay(scale=6, pitch=9, colour=(224, 224, 224))),
        (
            "gui_scale = 3\nline_pitch = 10\ntext_colour = [255, 255, 255]",
            Overlay(scale=3, pitch=10, colour=(255, 255, 255)),
        ),
    ],
    ids=["nothing", "no scale", "the scale alone", "everything"],
)
def test_a_profile_that_says_the_gui_scale_says_how_the_screen_is_drawn(screen: str, overlay: Overlay | None) -> None:
    assert overlay_of(parse_profile(f"[screen]\n{screen}\n", "here")) == overlay
