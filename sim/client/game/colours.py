"""Colours of text, red, green and blue."""

Colour = tuple[int, int, int]

WHITE: Colour = (255, 255, 255)
GREY: Colour = (160, 160, 160)
PLAIN: Colour = (224, 224, 224)
DRAFT: Colour = (170, 170, 170)
RED: Colour = (255, 85, 85)

TEXT: Colour = (224, 224, 224)
"""The debug screen's text."""
GLUE: Colour = (208, 208, 208)
"""What stands between the values of 26.4's debug screen, which are white."""
