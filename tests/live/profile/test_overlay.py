"""The overlay that a profile describes: how the debug screen is drawn."""

import dataclasses
from pathlib import Path

import pytest

from mc_nested.live.profile.overlay import overlay_of
from mc_nested.live.profile.store import load_profile, parse_profile
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.standin import STANDIN
from scripts.standin_game import write_profile

GREY, WHITE = (224, 224, 224), (255, 255, 255)


@pytest.mark.parametrize(
    ("screen", "overlay"),
    [
        ("", None),
        ("line_pitch = 10\ntext_colour = [255, 255, 255]", None),
        ("layout = 'stand-in'", None),
        ("debug_scale = 6", Overlay(6, VANILLA, GREY)),
        ("debug_scale = 3\nlayout = 'vanilla'\ntext_colour = [1, 2, 3]", Overlay(3, VANILLA, (1, 2, 3))),
        ("debug_scale = 3\nlayout = 'stand-in'", Overlay(3, STANDIN, WHITE)),
        ("debug_scale = 3\nline_pitch = 12", Overlay(3, dataclasses.replace(VANILLA, pitch=12), GREY)),
        (
            "debug_scale = 3\nlayout = 'vanilla'\nline_pitch = 10",
            Overlay(3, dataclasses.replace(VANILLA, pitch=10), GREY),
        ),
    ],
)
def test_a_profile_with_a_debug_scale_gives_an_overlay(screen: str, overlay: Overlay | None) -> None:
    assert overlay_of(parse_profile(f"[screen]\n{screen}\n", "here")) == overlay


def test_the_stand_ins_own_profile_names_its_layout(tmp_path: Path) -> None:
    profile = load_profile(write_profile(tmp_path / "profile.toml", tmp_path / "ascii.png"))
    assert profile.screen.layout == "stand-in"
    assert overlay_of(profile) == Overlay(3, STANDIN, WHITE)
