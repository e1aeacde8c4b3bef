"""The colours that the game writes its texts in, as red, green, blue, and how far off a screen may show them."""

Colour = tuple[int, int, int]
"""Red, green, blue."""

INK_SPREAD = 4
"""How far a channel of the ink may lie from the text's: 221 to 224 were seen for 224 (FACTS: The F3 debug screen)."""

PLAIN: Colour = (224, 224, 224)
"""The debug screen's text, what is typed into the chat, and the buttons' labels before 1.16."""

WHITE: Colour = (255, 255, 255)
GLUE: Colour = (208, 208, 208)
"""What stands between the values, which are white, of the debug screen from 26.4 on."""

PURE_GREEN: Colour = (0, 255, 0)
PURE_RED: Colour = (255, 0, 0)
GREY: Colour = (170, 170, 170)
AQUA: Colour = (85, 255, 255)
YELLOW: Colour = (255, 255, 85)
GREEN: Colour = (85, 255, 85)
LIGHT_PURPLE: Colour = (255, 85, 255)
GOLD: Colour = (255, 170, 0)
RED: Colour = (255, 85, 85)

UNDER_MOUSE: Colour = (255, 255, 160)
"""A button's label while the mouse is over it."""

DISABLED: Colour = (160, 160, 160)
"""The label of a button that can't be pressed now."""
