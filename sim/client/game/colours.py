"""Colours of text, red, green and blue."""

Colour = tuple[int, int, int]

WHITE: Colour = (255, 255, 255)
GREY: Colour = (160, 160, 160)
RED: Colour = (255, 85, 85)
