"""The game's numbers and rules, pure: walking, coordinates, what a reading holds, the names of keys."""
