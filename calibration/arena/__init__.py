"""The arena: marked where the player stands, surveyed, confirmed by the player, built and undone."""
