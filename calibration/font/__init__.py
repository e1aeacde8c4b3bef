"""The font that the game is written in: where it may be, which one reads the screen, and why none does."""
