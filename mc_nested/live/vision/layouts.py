"""The layouts that a profile may name, and that are looked for on a screen."""

from collections.abc import Mapping

from mc_nested.live.vision.layout import BOXES, VANILLA, LayoutName, ScreenLayout
from mc_nested.live.vision.standin import STANDIN

LAYOUTS: Mapping[LayoutName, ScreenLayout] = {layout.name: layout for layout in (VANILLA, BOXES, STANDIN)}
