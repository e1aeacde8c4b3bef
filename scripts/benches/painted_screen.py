"""A debug screen drawn over a picture of the world, for tests and measurements of what is read."""

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from sim.client.drawing.f3_layers import F3Layers
from sim.client.drawing.layers import draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.f3_screen import F3Screen


def paint(world: Frame, screen: F3Screen, font: Font) -> Frame:
    """Return the world (height, width, 3), blue green red, with the debug screen over it; ``world`` is not changed.

    Text that doesn't fit is cut at the window's edge, and the right column is drawn over the left one, as in the game.
    """
    frame: Frame = world.copy()
    height, width = world.shape[:2]
    gui = (-(-width // screen.gui_scale), -(-height // screen.gui_scale))
    layers = F3Layers(Letters(font, screen.gui_scale), gui).of(screen)
    draw_all(frame, layers, (0, 0, width, height))
    return frame
