"""The desktop around the game: its clock, the game's window, and the five devices."""
