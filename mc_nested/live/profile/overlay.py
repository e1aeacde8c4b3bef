"""The overlay that a profile describes: how the debug screen is drawn."""

import dataclasses

from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import LAYOUTS


def overlay_of(profile: Profile) -> Overlay | None:
    """Return the overlay of a profile that names its scale: what else it leaves out is its layout's.

    None where the scale, and with it all the rest, is found on the screen.
    """
    screen = profile.screen
    if screen.debug_scale is None:
        return None
    layout = LAYOUTS[screen.layout] if screen.layout else VANILLA
    if screen.line_pitch is not None:
        layout = dataclasses.replace(layout, pitch=screen.line_pitch)
    return Overlay(screen.debug_scale, layout, screen.text_colour or layout.text_colour)
