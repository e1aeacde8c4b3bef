"""Click points: the buttons of the game's menus, found by their labels or recorded by hand, and shown to the player."""
