"""Play in a running game: turn an action into timed keys, and the pixels of its window back into a state."""
